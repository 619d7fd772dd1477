// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/fill_holes.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"

namespace gyre {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Longer rims are filled by the Delaunay triangles of their vertices or not at all: the search
// through all triangulations grows with the cube of their length.
constexpr std::size_t kMaxSearchedRim = 400;

using Made = std::vector<SurfaceMesh::Vertex_index>;

struct Rim {
  SurfaceMesh::Halfedge_index border;
  std::vector<std::uint32_t> vertices;
  Bounds bounds;
};

Eigen::Vector3d positionOf(const SurfaceMesh& surface, SurfaceMesh::Vertex_index vertex) {
  const auto& point = surface.point(vertex);
  return {point.x(), point.y(), point.z()};
}

std::vector<Rim> findRims(const SurfaceMesh& surface) {
  std::vector<SurfaceMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
  std::vector<Rim> rims;
  for (const auto border : borders) {
    Rim rim;
    rim.border = border;
    for (const auto vertex : surface.vertices_around_face(border)) {
      rim.vertices.push_back(vertex);
      rim.bounds.include(positionOf(surface, vertex));
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

// Colour of the rim as seen from the place: each vertex weighs with its inverse squared distance.
Rgb colourFrom(const Mesh& mesh, const Rim& rim, const Eigen::Vector3d& place) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const std::uint32_t v : rim.vertices) {
    const MeshVertex& vertex = mesh.vertices[v];
    const double weight = 1.0 / std::max(1e-12, (vertex.position - place).squaredNorm());
    sum += weight * Eigen::Vector3d(vertex.rgb[0], vertex.rgb[1], vertex.rgb[2]);
    weights += weight;
  }
  const Eigen::Vector3d mean = (sum / weights).array().round();
  return {static_cast<std::uint8_t>(mean[0]), static_cast<std::uint8_t>(mean[1]),
          static_cast<std::uint8_t>(mean[2])};
}

// How a filling meets the surface around it; each is tried where the one before came to cross it.
enum class Bending { kSmooth, kCreased, kNone };

bool ranAway(const SurfaceMesh& surface, const Rim& rim, const Made& made) {
  const Eigen::Vector3d centre = 0.5 * (rim.bounds.min + rim.bounds.max);
  return std::any_of(made.begin(), made.end(), [&](const auto vertex) {
    return !((positionOf(surface, vertex) - centre).norm() <= rim.bounds.diagonal());
  });
}

// Bending that runs away over a ragged rim is worse than a crease.
void bend(SurfaceMesh& surface, const Rim& rim, const Made& made, Bending bending) {
  if (made.empty() || bending == Bending::kNone) return;
  if (bending == Bending::kSmooth) {
    pmp::fair(surface, made, CGAL::parameters::fairing_continuity(1));
    if (!ranAway(surface, rim, made)) return;
  }
  pmp::fair(surface, made, CGAL::parameters::fairing_continuity(0));
}

// Fills one hole and appends what it made; tells whether it could.
bool fillOne(SurfaceMesh& surface, const Rim& rim, Bending bending, Mesh& mesh) {
  std::vector<SurfaceMesh::Face_index> faces;
  Made made;
  pmp::triangulate_and_refine_hole(
      surface, rim.border, std::back_inserter(faces), std::back_inserter(made),
      CGAL::parameters::do_not_use_cubic_algorithm(rim.vertices.size() > kMaxSearchedRim));
  if (faces.empty()) return false;
  bend(surface, rim, made, bending);
  mesh.vertices.resize(surface.num_vertices());
  for (const auto vertex : made) {
    const Eigen::Vector3d position = positionOf(surface, vertex);
    mesh.vertices[vertex] = unseenVertex(position, colourFrom(mesh, rim, position));
  }
  for (const auto face : faces) {
    Triangle triangle{};
    std::size_t place = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      triangle[place++] = vertex;
    }
    mesh.triangles.push_back(triangle);
  }
  return true;
}

double areaFrom(const Mesh& mesh, std::size_t first) {
  double sum_mm2 = 0.0;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& at = mesh.vertices[a].position;
    sum_mm2 += 0.5 * (mesh.vertices[b].position - at).cross(mesh.vertices[c].position - at).norm();
  }
  return sum_mm2;
}

class Filler {
 public:
  Filler(const Mesh& mesh, const FillHolesOptions& options)
      : mesh_(mesh), start_(surfaceMeshOf<SurfaceMesh>(mesh)) {
    for (Rim& rim : findRims(start_)) {
      ++filled_.holes_left;
      const bool wanted = rim.bounds.diagonal() <= options.max_width_mm &&
                          rim.bounds.max.z() > options.spare_below_mm;
      if (wanted) rims_.push_back(std::move(rim));
    }
    bending_.assign(rims_.size(), Bending::kSmooth);
  }

  Result<FilledMesh> run(const Task& task) {
    do {
      if (task.stopRequested()) return cancelled();
      if (!fillAll(task)) return cancelled();
      const Result<bool> calmed = calmCrossings(task);
      if (!calmed) return calmed.error();
      if (!*calmed) break;
    } while (true);
    const auto first = static_cast<std::uint32_t>(mesh_.triangles.size());
    filled_.filled_mm2 = areaFrom(filled_.mesh, first);
    filled_.holes_left -= filled_.holes_filled;
    divideSeenTriangles(filled_.mesh, first);
    computeNormals(filled_.mesh);
    return std::move(filled_);
  }

 private:
  // False when stopped.
  bool fillAll(const Task& task) {
    SurfaceMesh surface = start_;
    filled_.mesh = mesh_;
    filled_.holes_filled = 0;
    ends_.clear();
    for (std::size_t i = 0; i < rims_.size(); ++i) {
      if (task.stopRequested()) return false;
      task.report(static_cast<double>(i) / static_cast<double>(rims_.size()), "Filling holes");
      if (fillOne(surface, rims_[i], bending_[i], filled_.mesh)) ++filled_.holes_filled;
      ends_.push_back(filled_.mesh.triangles.size());
    }
    return true;
  }

  // Bends the fillings less that cross something; tells whether there were any.
  Result<bool> calmCrossings(const Task& task) {
    if (filled_.holes_filled == 0) return false;
    const auto crossings = findSelfIntersections(filled_.mesh, task);
    if (!crossings) return crossings.error();
    std::vector<bool> crosses(rims_.size(), false);
    for (const auto& pair : *crossings) {
      for (const std::uint32_t t : pair) {
        if (t < mesh_.triangles.size()) continue;
        const auto end = std::upper_bound(ends_.begin(), ends_.end(), t);
        crosses[static_cast<std::size_t>(end - ends_.begin())] = true;
      }
    }
    bool any = false;
    for (std::size_t i = 0; i < rims_.size(); ++i) {
      if (!crosses[i] || bending_[i] == Bending::kNone) continue;
      bending_[i] = bending_[i] == Bending::kSmooth ? Bending::kCreased : Bending::kNone;
      any = true;
    }
    return any;
  }

  const Mesh& mesh_;
  const SurfaceMesh start_;
  std::vector<Rim> rims_;
  std::vector<Bending> bending_;
  std::vector<std::size_t> ends_;  // of each rim's triangles
  FilledMesh filled_;
};

}  // namespace

Result<FilledMesh> fillHoles(const Mesh& mesh, const FillHolesOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  return guarded("The filling of holes", [&] { return Filler(mesh, options).run(task); });
}

}  // namespace gyre
