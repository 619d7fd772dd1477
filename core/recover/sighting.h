// Where one view saw a point.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace gyre {

// Freed of intrinsics and distortion.
struct Sighting {
  std::int32_t view = 0;
  Eigen::Vector2d normalized = Eigen::Vector2d::Zero();  // undistorted x/z, y/z
  double sigma = 1e-4;                                   // standard deviation of either, same unit
};

}  // namespace gyre
