// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/crop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/mesh/clean/blend.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/cutter.h"
#include "core/mesh/clean/cylinder_dips.h"
#include "core/mesh/components.h"

namespace gyre {
namespace {

// Vertices nearer to the cut than this share of the mesh's size lie on it.
constexpr double kOnCut = 1e-10;

// What a triangle leaves: three or four vertices, or none.
using Remainder = std::vector<std::uint32_t>;

template <class Cutter>
class MeshCut {
 public:
  MeshCut(const Mesh& mesh, const Cutter& cutter) : cutter_(cutter) {
    cut_.mesh.vertices = mesh.vertices;
    const double on_mm = kOnCut * boundsOf(mesh).diagonal();
    outside_mm_.reserve(mesh.vertices.size());
    for (MeshVertex& vertex : cut_.mesh.vertices) {
      double outside_mm = cutter.outside_mm(vertex.position);
      if (std::abs(outside_mm) <= on_mm) {
        cutter.settle(vertex.position);
        outside_mm = 0.0;
      }
      outside_mm_.push_back(outside_mm);
    }
    for (const Triangle& triangle : mesh.triangles) cutOne(triangle);
    removeUnusedVertices(cut_.mesh);
  }

  CroppedMesh take() { return std::move(cut_); }

 private:
  void cutOne(const Triangle& triangle) {
    const auto out = std::count_if(triangle.begin(), triangle.end(),
                                   [&](std::uint32_t vertex) { return outside_mm_[vertex] > 0.0; });
    if (out == 0) {
      cut_.mesh.triangles.push_back(triangle);
      return;
    }
    const Remainder remainder = out == 3 ? Remainder{} : remainderOf(triangle);
    if (remainder.size() < 3) {
      ++cut_.triangles_removed;
      return;
    }
    ++cut_.triangles_cut;
    addPolygon(remainder);
  }

  Remainder remainderOf(const Triangle& triangle) {
    Remainder remainder;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t here = triangle[i];
      const std::uint32_t next = triangle[(i + 1) % 3];
      const bool here_out = outside_mm_[here] > 0.0;
      const bool next_out = outside_mm_[next] > 0.0;
      if (!here_out) remainder.push_back(here);
      if (here_out != next_out) {
        remainder.push_back(here_out ? crossing(next, here) : crossing(here, next));
      }
    }
    remainder.erase(std::unique(remainder.begin(), remainder.end()), remainder.end());
    if (remainder.size() > 1 && remainder.front() == remainder.back()) remainder.pop_back();
    return remainder;
  }

  // The vertex where the edge crosses the cut; the inner end itself where that lies on it.
  std::uint32_t crossing(std::uint32_t inside, std::uint32_t outside) {
    if (outside_mm_[inside] == 0.0) return inside;
    const auto [place, is_new] = crossings_.try_emplace(std::pair(inside, outside), 0U);
    if (!is_new) return place->second;
    std::vector<MeshVertex>& vertices = cut_.mesh.vertices;
    const double share = std::clamp(
        cutter_.crossing(vertices[inside].position, vertices[outside].position), 0.0, 1.0);
    MeshVertex vertex = blend(std::array<WeightedVertex, 2>{
        {{&vertices[inside], 1.0 - share}, {&vertices[outside], share}}});
    cutter_.settle(vertex.position);
    place->second = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    return place->second;
  }

  void addPolygon(const Remainder& polygon) {
    std::vector<Triangle>& triangles = cut_.mesh.triangles;
    if (polygon.size() == 3) {
      triangles.push_back({polygon[0], polygon[1], polygon[2]});
      return;
    }
    const auto squared = [&](std::size_t a, std::size_t b) {
      return (cut_.mesh.vertices[polygon[a]].position - cut_.mesh.vertices[polygon[b]].position)
          .squaredNorm();
    };
    const std::size_t first = squared(0, 2) <= squared(1, 3) ? 0 : 1;
    const auto corner = [&](std::size_t i) { return polygon[(first + i) % 4]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    triangles.push_back({corner(0), corner(2), corner(3)});
  }

  const Cutter cutter_;
  CroppedMesh cut_;
  std::vector<double> outside_mm_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

template <class Cutter>
void cutOff(const Cutter& cutter, CroppedMesh& cropped) {
  CroppedMesh cut = MeshCut<Cutter>(cropped.mesh, cutter).take();
  cropped.mesh = std::move(cut.mesh);
  cropped.triangles_removed += cut.triangles_removed;
  cropped.triangles_cut += cut.triangles_cut;
}

Result<void> checkLimits(const CropOptions& options) {
  if (options.x_min_mm < options.x_max_mm && options.y_min_mm < options.y_max_mm &&
      options.z_min_mm < options.z_max_mm) {
    return {};
  }
  return Error{Error::Code::kInvalidInput, "A lower limit of the crop is not below its upper one.",
               "Exchange the two limits."};
}

}  // namespace

Result<CroppedMesh> cropMesh(const Mesh& mesh, const CropOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> valid = checkLimits(options); !valid) return valid.error();
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  CroppedMesh cropped;
  cropped.mesh = mesh;
  const std::array<PlaneCutter, 6> planes = {{{0, options.x_min_mm, -1.0},
                                              {0, options.x_max_mm, 1.0},
                                              {1, options.y_min_mm, -1.0},
                                              {1, options.y_max_mm, 1.0},
                                              {2, options.z_min_mm, -1.0},
                                              {2, options.z_max_mm, 1.0}}};
  for (const PlaneCutter& plane : planes) {
    if (task.stopRequested()) return cancelled();
    if (std::abs(plane.at_mm) < kNoCrop_mm) cutOff(plane, cropped);
  }
  if (options.radius_mm > 0.0) {
    if (task.stopRequested()) return cancelled();
    splitDips(cropped.mesh, options.radius_mm);
    cutOff(CylinderCutter{options.radius_mm}, cropped);
  }
  if (task.stopRequested()) return cancelled();
  return cropped;
}

}  // namespace gyre
