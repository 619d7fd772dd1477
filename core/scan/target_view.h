// What one picture showed of a calibration target.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace gyre {

struct PointSighting {
  int point = 0;                                    // index into pointsOf(target)
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // raw (distorted) picture coordinates
  double sigma_px = 0.05;                           // standard deviation of either coordinate
};

struct TargetView {
  std::string name;                       // of the picture, for messages and files
  std::optional<double> table_angle_rad;  // as commanded; none when nobody knows
  std::vector<PointSighting> sightings;   // each point at most once
};

}  // namespace gyre
