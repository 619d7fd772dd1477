// Finds corners of a picture by where they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/calib/corners/x_corner_detector.h"

namespace gyre {

// Keeps the places of the corners it is made from, in square cells; answers are their indices.
class CornerIndex {
 public:
  explicit CornerIndex(std::span<const XCorner> corners);

  // The nearest one within the radius, -1 when there is none.
  int nearestWithin(const Eigen::Vector2d& pixel, double radius_px) const;

  // The nearest ones, by distance; equals in their order.
  std::vector<int> nearest(const Eigen::Vector2d& pixel, std::size_t count) const;

 private:
  template <class Visit>
  void visitRing(int column, int row, int ring, Visit visit) const;

  std::vector<Eigen::Vector2d> pixels_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

}  // namespace gyre
