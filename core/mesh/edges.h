// The edges of a mesh and the triangles at each.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// One triangle's use of an edge. Uses of the same edge lie side by side in the list below.
struct EdgeUse {
  std::uint32_t low = 0;  // the smaller of the two vertex indices
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;  // the triangle runs from low to high

  bool sameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

// Three for each triangle, sorted by edge, then by triangle.
inline std::vector<EdgeUse> edgeUses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangles[t][i];
      const std::uint32_t to = triangles[t][(i + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  return uses;
}

// Calls visit(begin, end) with the uses of each edge in turn.
template <class Visit>
void forEachEdge(const std::vector<EdgeUse>& uses, const Visit& visit) {
  for (auto begin = uses.begin(); begin != uses.end();) {
    auto end = begin;
    while (end != uses.end() && end->sameEdge(*begin)) ++end;
    visit(begin, end);
    begin = end;
  }
}

}  // namespace gyre
