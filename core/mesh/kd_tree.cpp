// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/kd_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr std::uint32_t kLeafSize = 8;

bool nearer(const KdTree::Neighbour& a, const KdTree::Neighbour& b) {
  return a.squared_mm2 != b.squared_mm2 ? a.squared_mm2 < b.squared_mm2 : a.index < b.index;
}

}  // namespace

KdTree::KdTree(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {
  GYRE_CHECK(points_.size() < std::numeric_limits<std::uint32_t>::max());
  order_.resize(points_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(points_.size() / 2 + 1);
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

std::uint32_t KdTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({begin, end, 0, 0, 0.0});
  if (end - begin <= kLeafSize) return id;

  Eigen::Vector3d low = points_[order_[begin]];
  Eigen::Vector3d high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = low.cwiseMin(points_[order_[i]]);
    high = high.cwiseMax(points_[order_[i]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) {
        return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
      });
  nodes_[id].axis = axis;
  nodes_[id].split = points_[order_[middle]][axis];
  build(begin, middle);
  nodes_[id].right = build(middle, end);
  return id;
}

// Calls visit(neighbour) for every point that may lie within limit(), a squared distance that may
// shrink on the way.
template <class Visit, class Limit>
void KdTree::search(const Eigen::Vector3d& place, const Visit& visit, const Limit& limit) const {
  if (nodes_.empty()) return;
  struct Pending {
    std::uint32_t node;
    double squared_mm2;  // lower bound of the distance to anything below the node
  };
  std::array<Pending, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, 0.0};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (next.squared_mm2 > limit()) continue;
    const Node& node = nodes_[next.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        visit(Neighbour{order_[i], (points_[order_[i]] - place).squaredNorm()});
      }
      continue;
    }
    const double offset = place[node.axis] - node.split;
    const double far_bound = std::max(next.squared_mm2, offset * offset);
    const std::uint32_t left = next.node + 1;
    stack[depth++] = {offset < 0.0 ? node.right : left, far_bound};
    stack[depth++] = {offset < 0.0 ? left : node.right, next.squared_mm2};
  }
}

std::vector<KdTree::Neighbour> KdTree::nearest(const Eigen::Vector3d& place,
                                               std::size_t count) const {
  std::vector<Neighbour> heap;  // the farthest kept neighbour on top
  if (count == 0) return heap;
  heap.reserve(count + 1);
  const auto limit = [&] {
    return heap.size() < count ? std::numeric_limits<double>::infinity() : heap.front().squared_mm2;
  };
  search(
      place,
      [&](const Neighbour& candidate) {
        if (heap.size() == count && !nearer(candidate, heap.front())) return;
        heap.push_back(candidate);
        std::push_heap(heap.begin(), heap.end(), nearer);
        if (heap.size() > count) {
          std::pop_heap(heap.begin(), heap.end(), nearer);
          heap.pop_back();
        }
      },
      limit);
  std::sort_heap(heap.begin(), heap.end(), nearer);
  return heap;
}

std::vector<KdTree::Neighbour> KdTree::within(const Eigen::Vector3d& place,
                                              double radius_mm) const {
  std::vector<Neighbour> found;
  const double squared_mm2 = radius_mm * radius_mm;
  search(
      place,
      [&](const Neighbour& candidate) {
        if (candidate.squared_mm2 <= squared_mm2) found.push_back(candidate);
      },
      [&] { return squared_mm2; });
  std::sort(found.begin(), found.end(), nearer);
  return found;
}

}  // namespace gyre
