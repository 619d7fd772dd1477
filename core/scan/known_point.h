// A point whose place is known, and where a picture shows it: what a camera is calibrated from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace gyre {

struct KnownPoint {
  Eigen::Vector3d position_in_target = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();               // raw (distorted) coordinates
  double sigma_px = 0.1;  // standard deviation of either pixel coordinate, > 0
};

}  // namespace gyre
