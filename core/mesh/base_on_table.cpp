// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_on_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/median.h"
#include "core/mesh/unseen_facets.h"

namespace gyre {
namespace {

// Of the object's size: nothing is seen of a base so near to the table.
constexpr double kBlindShare = 0.025;
constexpr double kLowestQuantile = 0.002;
constexpr double kBelowSpacings = 0.25;  // what reaches farther below is no noise: no table there
constexpr double kLooksDown = -0.5;      // z of a facet's normal

double lowestOf(const Mesh& mesh) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) heights.push_back(vertex.position.z());
  const auto at = heights.begin() + static_cast<std::ptrdiff_t>(
                                        kLowestQuantile * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

// Along the triangle's outward normal, twice as long as its area.
Eigen::Vector3d doubleArea(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d& first = mesh.vertices[a].position;
  return (mesh.vertices[b].position - first).cross(mesh.vertices[c].position - first);
}

bool looksDown(const Mesh& mesh, const Triangle& triangle) {
  return doubleArea(mesh, triangle).stableNormalized().z() < kLooksDown;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The wide triangles that look down, in patches that hang together by edges.
std::vector<std::vector<std::size_t>> widePatches(const Mesh& mesh,
                                                  const std::vector<double>& spacing_mm) {
  std::map<Edge, std::size_t> by_edge;
  std::set<std::size_t> waiting;
  const auto for_edges = [&](std::size_t i, const auto& visit) {
    for (std::size_t side = 0; side < 3; ++side) {
      visit(mesh.triangles[i][side], mesh.triangles[i][(side + 1) % 3]);
    }
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& triangle = mesh.triangles[i];
    if (!isWideFacet(mesh, spacing_mm, triangle) || !looksDown(mesh, triangle)) continue;
    waiting.insert(i);
    for_edges(i, [&](std::uint32_t from, std::uint32_t to) { by_edge[{from, to}] = i; });
  }
  std::vector<std::vector<std::size_t>> patches;
  while (!waiting.empty()) {
    std::vector<std::size_t> open = {*waiting.begin()};
    waiting.erase(waiting.begin());
    patches.emplace_back();
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      patches.back().push_back(at);
      for_edges(at, [&](std::uint32_t from, std::uint32_t to) {
        const auto beyond = by_edge.find({to, from});
        if (beyond == by_edge.end() || waiting.erase(beyond->second) == 0) return;
        open.push_back(beyond->second);
      });
    }
  }
  return patches;
}

// The triangles of the base: the patches that lie near the table as a whole.
class Base {
 public:
  Base(const Mesh& mesh, const std::vector<double>& spacing_mm, double blind_mm) {
    double low_mm2 = 0.0;
    double high_mm2 = 0.0;
    for (const auto& patch : widePatches(mesh, spacing_mm)) {
      double area_mm2 = 0.0;
      for (const std::size_t i : patch)
        area_mm2 += 0.5 * doubleArea(mesh, mesh.triangles[i]).norm();
      const bool low = std::all_of(patch.begin(), patch.end(), [&](std::size_t i) {
        const Triangle& triangle = mesh.triangles[i];
        return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
          return mesh.vertices[corner].position.z() < blind_mm;
        });
      });
      (low ? low_mm2 : high_mm2) += area_mm2;
      if (low) triangles_.insert(patch.begin(), patch.end());
    }
    // Resting on the lesser part of its base it would stand crooked.
    if (low_mm2 < high_mm2) triangles_.clear();
    while (dropPinched(mesh)) continue;
  }

  bool empty() const { return triangles_.empty(); }
  const std::set<std::size_t>& triangles() const { return triangles_; }

  // Directed edges that one triangle of the base has and none of its others shares.
  std::vector<Edge> rim(const Mesh& mesh) const {
    std::set<Edge> edges;
    for (const std::size_t i : triangles_) {
      for (std::size_t side = 0; side < 3; ++side) {
        edges.insert({mesh.triangles[i][side], mesh.triangles[i][(side + 1) % 3]});
      }
    }
    std::vector<Edge> rim;
    for (const auto& [from, to] : edges) {
      if (!edges.contains({to, from})) rim.push_back({from, to});
    }
    return rim;
  }

 private:
  // Where two parts of the base meet in a single vertex a wall would stand on itself.
  bool dropPinched(const Mesh& mesh) {
    std::map<std::uint32_t, int> leaving;
    for (const auto& [from, to] : rim(mesh)) ++leaving[from];
    const auto pinched = [&](std::uint32_t corner) {
      const auto found = leaving.find(corner);
      return found != leaving.end() && found->second > 1;
    };
    const std::size_t before = triangles_.size();
    std::erase_if(triangles_, [&](std::size_t i) {
      return std::any_of(mesh.triangles[i].begin(), mesh.triangles[i].end(), pinched);
    });
    return triangles_.size() < before;
  }

  std::set<std::size_t> triangles_;
};

}  // namespace

void restOnTable(Mesh& mesh, std::vector<double>& spacing_mm) {
  GYRE_CHECK(spacing_mm.size() == mesh.vertices.size());
  const double blind_mm = kBlindShare * boundsOf(mesh).diagonal();
  if (mesh.vertices.empty()) return;
  const double lowest_mm = lowestOf(mesh);
  if (lowest_mm > blind_mm || lowest_mm < -kBelowSpacings * median(spacing_mm)) return;
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.position.z() = std::max(vertex.position.z(), 0.0);
  }
  const Base base(mesh, spacing_mm, blind_mm);
  if (base.empty()) return;
  const auto rim = base.rim(mesh);

  std::map<std::uint32_t, std::uint32_t> foot_of;
  const auto foot_at = [&](std::uint32_t vertex) {
    const auto [found, fresh] =
        foot_of.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (fresh) {
      MeshVertex foot = mesh.vertices[vertex];
      foot.position.z() = 0.0;
      foot.views = 0;
      foot.seen = 0;
      mesh.vertices.push_back(foot);
      spacing_mm.push_back(spacing_mm[vertex]);
    }
    return found->second;
  };
  for (const std::size_t i : base.triangles()) {
    for (std::uint32_t& corner : mesh.triangles[i]) corner = foot_at(corner);
  }
  for (const auto& [from, to] : rim) {
    mesh.triangles.push_back({from, to, foot_at(to)});
    mesh.triangles.push_back({from, foot_at(to), foot_at(from)});
  }
}

}  // namespace gyre
