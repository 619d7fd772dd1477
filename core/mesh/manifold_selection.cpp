// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/manifold_selection.h"

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace gyre {
namespace {

std::uint64_t directedEdge(const Triangle& triangle, std::size_t side) {
  return std::uint64_t{triangle[side]} << 32U | triangle[(side + 1) % 3];
}

}  // namespace

std::vector<Triangle> selectManifold(std::vector<TriangleCandidate> candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const TriangleCandidate& a, const TriangleCandidate& b) { return a.cost < b.cost; });
  std::unordered_set<std::uint64_t> used;
  used.reserve(3 * candidates.size());
  std::vector<Triangle> taken;
  for (const TriangleCandidate& candidate : candidates) {
    bool free = true;
    for (std::size_t side = 0; side < 3; ++side) {
      free = free && !used.contains(directedEdge(candidate.corners, side));
    }
    if (!free) continue;
    for (std::size_t side = 0; side < 3; ++side) used.insert(directedEdge(candidate.corners, side));
    taken.push_back(candidate.corners);
  }
  return taken;
}

}  // namespace gyre
