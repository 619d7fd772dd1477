// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/base_cap.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/base_facets.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/flat_lid.h"
#include "core/mesh/clean/rims.h"
#include "core/mesh/clean/split_non_manifold.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/components.h"
#include "core/mesh/kd_tree.h"

namespace gyre {
namespace {

constexpr int kMaxSmoothings = 60;   // of lines that cross, before giving up
constexpr double kLidSpacing = 3.0;  // of the lid's points, in mean edges of the rims
constexpr auto kNoVertex = std::numeric_limits<std::uint32_t>::max();

std::vector<Rim> rimsNearBase(const Mesh& mesh, const BaseCapOptions& options) {
  std::vector<Rim> rims = findRims(mesh);
  std::erase_if(rims, [&](const Rim& rim) {
    return std::any_of(rim.begin(), rim.end(), [&](std::uint32_t vertex) {
      return mesh.vertices[vertex].position.z() > options.z_mm + options.tolerance_mm;
    });
  });
  return rims;
}

std::vector<PlaneLoop> loopsBelow(const Mesh& mesh, const std::vector<Rim>& rims) {
  std::vector<PlaneLoop> loops;
  for (const Rim& rim : rims) {
    PlaneLoop loop;
    for (const std::uint32_t vertex : rim) loop.push_back(mesh.vertices[vertex].position.head<2>());
    loops.push_back(std::move(loop));
  }
  return loops;
}

double meanEdge_mm(const std::vector<PlaneLoop>& loops) {
  double sum_mm = 0.0;
  std::size_t count = 0;
  for (const PlaneLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sum_mm += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    }
    count += loop.size();
  }
  return sum_mm / static_cast<double>(count);
}

// Moves the vertices that hang below the rim half way to the middle of their neighbours; those on
// the base already belong to the surface and stay.
void smoothLoops(const Mesh& mesh, const std::vector<Rim>& rims, double z_mm,
                 std::vector<PlaneLoop>& loops) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const PlaneLoop before = loops[l];
    const std::size_t count = before.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (mesh.vertices[rims[l][i]].position.z() == z_mm) continue;
      const Eigen::Vector2d middle =
          0.5 * (before[(i + 1) % count] + before[(i + count - 1) % count]);
      loops[l][i] = 0.5 * (before[i] + middle);
    }
  }
}

std::optional<FlatLid> makeLid(const Mesh& mesh, const std::vector<Rim>& rims, double z_mm) {
  std::vector<PlaneLoop> loops = loopsBelow(mesh, rims);
  const double spacing_mm = kLidSpacing * meanEdge_mm(loops);
  for (int round = 0; round < kMaxSmoothings; ++round) {
    if (auto lid = fillLoops(loops, spacing_mm)) return lid;
    smoothLoops(mesh, rims, z_mm, loops);
  }
  return std::nullopt;
}

// Joins lid and rims.
class BaseBuilder {
 public:
  BaseBuilder(CappedMesh& capped, const std::vector<Rim>& rims, FlatLid lid, double z_mm)
      : capped_(capped), rims_(rims), lid_(std::move(lid)), z_mm_(z_mm) {}

  void build() {
    const auto first = static_cast<std::uint32_t>(capped_.mesh.triangles.size());
    placeVertices();
    for (std::size_t l = 0; l < rims_.size(); ++l) addSkirt(l);
    addLid();
    divideSeenTriangles(capped_.mesh, first);
    capped_.rims_closed = rims_.size();
  }

 private:
  // Points of the lid that are vertices of the rim themselves keep these.
  void placeVertices() {
    std::vector<MeshVertex>& vertices = capped_.mesh.vertices;
    vertex_.assign(lid_.points.size(), kNoVertex);
    std::vector<std::uint32_t> above(lid_.on_loops, 0);
    for (std::size_t l = 0; l < rims_.size(); ++l) {
      for (std::size_t i = 0; i < rims_[l].size(); ++i) {
        const std::uint32_t rim_vertex = rims_[l][i];
        const std::uint32_t point = lid_.loops[l][i];
        const double height_mm = vertices[rim_vertex].position.z() - z_mm_;
        above[point] = rim_vertex;
        if (height_mm == 0.0) vertex_[point] = rim_vertex;
        capped_.tallest_skirt_mm = std::max(capped_.tallest_skirt_mm, height_mm);
      }
    }
    std::vector<Eigen::Vector3d> on_loops;
    for (std::size_t p = 0; p < lid_.on_loops; ++p) {
      on_loops.emplace_back(lid_.points[p].x(), lid_.points[p].y(), 0.0);
    }
    const KdTree tree(std::move(on_loops));
    for (std::size_t p = 0; p < lid_.points.size(); ++p) {
      if (vertex_[p] != kNoVertex) continue;
      const Eigen::Vector3d flat(lid_.points[p].x(), lid_.points[p].y(), 0.0);
      const Rgb rgb = vertices[above[tree.nearest(flat, 1).front().index]].rgb;
      vertex_[p] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(unseenVertex({flat.x(), flat.y(), z_mm_}, rgb));
    }
  }

  void addSkirt(std::size_t l) {
    const Rim& rim = rims_[l];
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::size_t next = (i + 1) % rim.size();
      const std::uint32_t a_below = vertex_[lid_.loops[l][i]];
      const std::uint32_t b_below = vertex_[lid_.loops[l][next]];
      addTriangle({rim[i], rim[next], b_below});
      addTriangle({rim[i], b_below, a_below});
      along_.emplace(a_below, b_below);
    }
  }

  void addTriangle(const Triangle& corners) {
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    capped_.mesh.triangles.push_back(corners);
  }

  // The lid looks down, but where most of the rims say that the mesh is inside out.
  void addLid() {
    std::vector<Triangle> lid;
    long agreement = 0;
    for (const auto& [a, b, c] : lid_.triangles) {
      lid.push_back({vertex_[a], vertex_[c], vertex_[b]});
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = lid.back()[i];
        const std::uint32_t to = lid.back()[(i + 1) % 3];
        if (along_.contains({from, to})) ++agreement;
        if (along_.contains({to, from})) --agreement;
      }
      const Eigen::Vector2d ab = lid_.points[b] - lid_.points[a];
      const Eigen::Vector2d ac = lid_.points[c] - lid_.points[a];
      capped_.base_mm2 += 0.5 * (ab.x() * ac.y() - ab.y() * ac.x());
    }
    for (Triangle& triangle : lid) {
      if (agreement < 0) std::swap(triangle[1], triangle[2]);
      capped_.mesh.triangles.push_back(triangle);
    }
  }

  CappedMesh& capped_;
  const std::vector<Rim>& rims_;
  FlatLid lid_;
  double z_mm_;
  std::vector<std::uint32_t> vertex_;                        // of the mesh, by point of the lid
  std::set<std::pair<std::uint32_t, std::uint32_t>> along_;  // edges as the lid must run there
};

Error crossing() {
  return {Error::Code::kInvalidInput,
          "The rim at the bottom crosses itself where it is led down to the base.",
          "Crop the mesh a little higher, or choose a smaller tolerance."};
}

// Surfaces that meet in a line or point of the base would share it.
Result<void> separate(CappedMesh& capped, const Task& task) {
  if (checkSurface(capped.mesh)) return {};
  auto split = splitNonManifold(capped.mesh, task);
  if (!split) return split.error();
  capped.mesh = std::move(split->mesh);
  return checkSurface(capped.mesh) ? Result<void>{} : crossing();
}

// Takes out the facets that only guess the base, so that what was measured can be led down.
void openGuessedBase(Mesh& mesh, const BaseCapOptions& options) {
  const auto is_unseen = [&](const Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t corner) { return mesh.vertices[corner].seen == 0; });
  };
  const auto base =
      withoutPinched(mesh, baseFacets(mesh, is_unseen, options.z_mm + options.tolerance_mm));
  std::vector<Triangle> kept;
  kept.reserve(mesh.triangles.size() - base.size());
  auto next = base.begin();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (next != base.end() && *next == t) {
      ++next;
    } else {
      kept.push_back(mesh.triangles[t]);
    }
  }
  mesh.triangles = std::move(kept);
  removeUnusedVertices(mesh);
}

// Whether a part of the surface lies in the base already.
bool restsOnBase(const Mesh& mesh, double z_mm) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      return mesh.vertices[corner].position.z() <= z_mm;
    });
  });
}

// Leads the rims near the base down and closes them.
Result<CappedMesh> closeRims(CappedMesh capped, const BaseCapOptions& options, const Task& task) {
  if (const Result<void> separated = separate(capped, task); !separated) return separated.error();
  const std::vector<Rim> rims = rimsNearBase(capped.mesh, options);
  if (rims.empty()) return capped;
  task.report(0.5, "Closing the base");
  return guarded("The triangulation of the base", [&]() -> Result<CappedMesh> {
    auto lid = makeLid(capped.mesh, rims, options.z_mm);
    if (!lid) return crossing();
    if (task.stopRequested()) return cancelled();
    BaseBuilder(capped, rims, std::move(*lid), options.z_mm).build();
    if (const Result<void> separated = separate(capped, task); !separated) {
      return separated.error();
    }
    computeNormals(capped.mesh);
    return std::move(capped);
  });
}

}  // namespace

Result<CappedMesh> capBase(const Mesh& mesh, const BaseCapOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  auto above = cropMesh(mesh, {.z_min_mm = options.z_mm}, task);
  if (!above) return above.error();
  CappedMesh capped;
  capped.mesh = std::move(above->mesh);
  if (const Result<void> separated = separate(capped, task); !separated) return separated.error();
  if (!findRims(capped.mesh).empty()) return closeRims(std::move(capped), options, task);
  if (restsOnBase(capped.mesh, options.z_mm)) return capped;
  CappedMesh opened = capped;
  openGuessedBase(opened.mesh, options);
  auto closed = closeRims(std::move(opened), options, task);
  if (!closed && closed.error().code == Error::Code::kCancelled) return closed;
  // A closed body stays one: where its base cannot be led down it stays where it is.
  if (!closed || !findRims(closed->mesh).empty()) return capped;
  return closed;
}

}  // namespace gyre
