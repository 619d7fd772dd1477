// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_facets.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include "core/mesh/disjoint_sets.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr double kLooksDown = -0.5;  // z of a facet's normal

// Along the triangle's outward normal, twice as long as its area.
Eigen::Vector3d doubleArea(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d& first = mesh.vertices[a].position;
  return (mesh.vertices[b].position - first).cross(mesh.vertices[c].position - first);
}

// Of triangles that hang together by edges.
struct Patch {
  std::vector<std::uint32_t> triangles;
  double area_mm2 = 0.0;
  bool low = true;
};

std::vector<Patch> patchesOf(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                             double below_mm) {
  DisjointSets sets(triangles.size());
  const std::vector<EdgeUse> uses = edgeUses(cornersOf(mesh, triangles));
  forEachEdge(uses, [&](auto begin, auto end) {
    for (auto use = begin; use != end; ++use) sets.join(begin->triangle, use->triangle);
  });
  std::map<std::uint32_t, Patch> patches;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& triangle = mesh.triangles[triangles[i]];
    Patch& patch = patches[sets.find(i)];
    patch.triangles.push_back(triangles[i]);
    patch.area_mm2 += 0.5 * doubleArea(mesh, triangle).norm();
    for (const std::uint32_t corner : triangle) {
      if (mesh.vertices[corner].position.z() >= below_mm) patch.low = false;
    }
  }
  std::vector<Patch> listed;
  listed.reserve(patches.size());
  for (auto& [first, patch] : patches) listed.push_back(std::move(patch));
  return listed;
}

// Whether any triangle was dropped.
bool dropPinched(const Mesh& mesh, std::vector<std::uint32_t>& triangles) {
  std::unordered_map<std::uint32_t, int> leaving;
  for (const DirectedEdge& edge : rimOf(mesh, triangles)) ++leaving[edge.from];
  const auto pinched = [&](std::uint32_t corner) {
    const auto found = leaving.find(corner);
    return found != leaving.end() && found->second > 1;
  };
  return std::erase_if(triangles, [&](std::uint32_t t) {
           return std::any_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), pinched);
         }) > 0;
}

}  // namespace

std::vector<DirectedEdge> rimOf(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<DirectedEdge> rim;
  const std::vector<EdgeUse> uses = edgeUses(cornersOf(mesh, triangles));
  forEachEdge(uses, [&](auto begin, auto end) {
    if (end - begin != 1) return;
    if (begin->forward) {
      rim.push_back({begin->low, begin->high, begin->triangle});
    } else {
      rim.push_back({begin->high, begin->low, begin->triangle});
    }
  });
  return rim;
}

std::vector<std::uint32_t> baseFacets(const Mesh& mesh,
                                      const std::function<bool(const Triangle&)>& is_guessed,
                                      double below_mm) {
  std::vector<std::uint32_t> down;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const double z = doubleArea(mesh, triangle).stableNormalized().z();
    if (z < kLooksDown && is_guessed(triangle)) down.push_back(t);
  }
  std::vector<std::uint32_t> base;
  double low_mm2 = 0.0;
  double high_mm2 = 0.0;
  for (const Patch& patch : patchesOf(mesh, down, below_mm)) {
    (patch.low ? low_mm2 : high_mm2) += patch.area_mm2;
    if (patch.low) base.insert(base.end(), patch.triangles.begin(), patch.triangles.end());
  }
  if (low_mm2 < high_mm2) return {};
  std::sort(base.begin(), base.end());
  return base;
}

std::vector<std::uint32_t> withoutPinched(const Mesh& mesh, std::vector<std::uint32_t> triangles) {
  while (dropPinched(mesh, triangles)) continue;
  return triangles;
}

std::vector<Triangle> cornersOf(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<Triangle> corners;
  corners.reserve(triangles.size());
  for (const std::uint32_t t : triangles) corners.push_back(mesh.triangles[t]);
  return corners;
}

}  // namespace gyre
