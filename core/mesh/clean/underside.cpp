// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/underside.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "core/mesh/disjoint_sets.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr double kLooksDown = -0.3;   // z of a facet's normal
constexpr double kLevelShare = 1e-4;  // of the diagonal: lower than this lies on the table

bool looksDown(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d& first = mesh.vertices[a].position;
  return (mesh.vertices[b].position - first)
             .cross(mesh.vertices[c].position - first)
             .stableNormalized()
             .z() < kLooksDown;
}

std::vector<std::uint32_t> guessedAndDown(const Mesh& mesh, double above_mm) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const bool guessed = std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      return mesh.vertices[corner].seen == 0;
    });
    const bool hangs = std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      return mesh.vertices[corner].position.z() > above_mm;
    });
    if (guessed && hangs && looksDown(mesh, triangle)) found.push_back(t);
  }
  return found;
}

}  // namespace

double tableLevel_mm(const Mesh& mesh) { return std::min(0.0, boundsOf(mesh).min.z()); }

std::vector<std::uint32_t> guessedUnderside(const Mesh& mesh, double min_share) {
  const double size_mm = boundsOf(mesh).diagonal();
  const auto found = guessedAndDown(mesh, tableLevel_mm(mesh) + kLevelShare * size_mm);
  std::vector<Triangle> triangles;
  triangles.reserve(found.size());
  for (const std::uint32_t t : found) triangles.push_back(mesh.triangles[t]);
  DisjointSets sets(found.size());
  forEachEdge(edgeUses(triangles), [&](auto begin, auto end) {
    for (auto use = begin; use != end; ++use) sets.join(begin->triangle, use->triangle);
  });
  std::map<std::uint32_t, Bounds> reach;
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    for (const std::uint32_t corner : triangles[i]) {
      reach[sets.find(i)].include(mesh.vertices[corner].position);
    }
  }
  std::vector<std::uint32_t> underside;
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    if (reach[sets.find(i)].diagonal() >= min_share * size_mm) underside.push_back(found[i]);
  }
  return underside;
}

}  // namespace gyre
