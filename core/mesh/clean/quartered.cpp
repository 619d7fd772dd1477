// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/quartered.h"

#include <array>
#include <vector>

#include "core/mesh/clean/blend.h"
#include "core/mesh/edges.h"

namespace gyre {

Mesh quartered(const Mesh& mesh) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  std::vector<std::array<std::uint32_t, 3>> opposite(mesh.triangles.size());  // middles, by corner
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    const auto middle = static_cast<std::uint32_t>(fine.vertices.size());
    fine.vertices.push_back(blend(std::array<WeightedVertex, 2>{
        {{&mesh.vertices[begin->low], 0.5}, {&mesh.vertices[begin->high], 0.5}}}));
    for (auto use = begin; use != end; ++use) {
      const Triangle& corners = mesh.triangles[use->triangle];
      for (std::size_t i = 0; i < 3; ++i) {
        if (corners[i] != use->low && corners[i] != use->high) opposite[use->triangle][i] = middle;
      }
    }
  });
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& [bc, ca, ab] = opposite[t];
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({b, bc, ab});
    fine.triangles.push_back({c, ca, bc});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace gyre
