// Finds the points nearest to a place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// A balanced tree over points that do not change. Reading is safe from any thread.
class KdTree {
 public:
  struct Neighbour {
    std::uint32_t index = 0;
    double squared_mm2 = 0.0;
  };

  explicit KdTree(std::vector<Eigen::Vector3d> points);

  std::size_t size() const { return points_.size(); }
  const Eigen::Vector3d& point(std::uint32_t index) const { return points_[index]; }

  // The nearest `count` points, or all when there are fewer, ascending by distance, then by index.
  // A point of the tree at `place` itself counts as well.
  std::vector<Neighbour> nearest(const Eigen::Vector3d& place, std::size_t count) const;

  // All points at most radius_mm away, in the same order.
  std::vector<Neighbour> within(const Eigen::Vector3d& place, double radius_mm) const;

 private:
  struct Node {
    std::uint32_t begin = 0;  // range in order_
    std::uint32_t end = 0;
    std::uint32_t right = 0;  // the left child follows its parent; 0 marks a leaf
    int axis = 0;
    double split = 0.0;
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  template <class Visit, class Limit>
  void search(const Eigen::Vector3d& place, const Visit& visit, const Limit& limit) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gyre
