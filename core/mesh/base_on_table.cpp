// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_on_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "core/base/check.h"
#include "core/base/median.h"
#include "core/mesh/base_facets.h"
#include "core/mesh/unseen_facets.h"

namespace gyre {
namespace {

// Of the object's size: nothing is seen of a base so near to the table.
constexpr double kBlindShare = 0.025;
constexpr double kLowestQuantile = 0.002;
constexpr double kBelowSpacings = 0.25;  // what reaches farther below is no noise: no table there

double lowestOf(const Mesh& mesh) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) heights.push_back(vertex.position.z());
  const auto at = heights.begin() + static_cast<std::ptrdiff_t>(
                                        kLowestQuantile * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

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
  const auto is_wide = [&](const Triangle& triangle) {
    return isWideFacet(mesh, spacing_mm, triangle);
  };
  const std::vector<std::uint32_t> base = baseFacets(mesh, is_wide, blind_mm);
  const std::vector<DirectedEdge> rim = rimOf(mesh, base);

  std::unordered_map<std::uint32_t, std::uint32_t> foot_of;
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
  for (const std::uint32_t i : base) {
    for (std::uint32_t& corner : mesh.triangles[i]) corner = foot_at(corner);
  }
  for (const auto& [from, to] : rim) {
    mesh.triangles.push_back({from, to, foot_at(to)});
    mesh.triangles.push_back({from, foot_at(to), foot_at(from)});
  }
}

}  // namespace gyre
