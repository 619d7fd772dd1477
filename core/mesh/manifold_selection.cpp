// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/manifold_selection.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace gyre {
namespace {

constexpr int kUntouched = -1;

std::uint64_t directedEdge(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32U | to;
}

class Selection {
 public:
  explicit Selection(const std::vector<TriangleCandidate>& candidates) {
    std::uint32_t last = 0;
    for (const TriangleCandidate& candidate : candidates) {
      last = std::max(last, *std::max_element(candidate.corners.begin(), candidate.corners.end()));
    }
    open_edges_.assign(last + std::size_t{1}, kUntouched);
    used_.reserve(3 * candidates.size());
  }

  bool fits(const Triangle& triangle) const {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t corner = triangle[side];
      if (used_.contains(directedEdge(corner, triangle[(side + 1) % 3]))) return false;
      if (open_edges_[corner] == 0) return false;  // its fan is complete
    }
    return true;
  }

  void add(const Triangle& triangle) {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t from = triangle[side];
      const std::uint32_t to = triangle[(side + 1) % 3];
      used_.insert(directedEdge(from, to));
      const int change = used_.contains(directedEdge(to, from)) ? -1 : 1;
      for (const std::uint32_t end : {from, to}) {
        open_edges_[end] = std::max(open_edges_[end], 0) + change;
      }
    }
    taken_.push_back(triangle);
  }

  std::vector<Triangle> take() { return std::move(taken_); }

 private:
  std::unordered_set<std::uint64_t> used_;
  std::vector<int> open_edges_;  // at each vertex, with one triangle; kUntouched before the first
  std::vector<Triangle> taken_;
};

}  // namespace

std::vector<Triangle> selectManifold(std::vector<TriangleCandidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const TriangleCandidate& a, const TriangleCandidate& b) {
                     return std::tie(a.level, a.cost) < std::tie(b.level, b.cost);
                   });
  Selection selection(candidates);
  for (const TriangleCandidate& candidate : candidates) {
    if (selection.fits(candidate.corners)) selection.add(candidate.corners);
  }
  return selection.take();
}

}  // namespace gyre
