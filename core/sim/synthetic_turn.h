// The paper's synthetic experiment: points in a sphere that every view of a turning table sees.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/track.h"

namespace gyre {

// Leow et al. (2000), section 4.1: a lens of 8 mm at 100 px/mm, twenty points in a sphere of
// 200 mm, steps of 1.8 deg. The paper leaves out distance and elevation.
struct SyntheticTurnOptions {
  int views = 20;
  double step_deg = 1.8;
  int points = 20;
  double sphere_radius_mm = 200.0;
  double distance_mm = 900.0;  // of the camera from the middle of the sphere, which is on the axis
  double elevation_deg = 25.0;
  double focal_px = 800.0;
  double noise_px = 0.0;           // standard deviation of either coordinate
  bool whole_pixels = true;        // coordinates are rounded, as the paper's are
  double angle_noise_deg = 0.0;    // of every view but the first
  double angle_scale_error = 0.0;  // 0.01: the table turns 1 % further than it is told
};

struct SyntheticTurn {
  CameraModel camera;
  std::vector<double> told_angles_rad;
  std::vector<double> true_angles_rad;
  std::vector<Rigid3> cam_from_table;            // at the angles told
  std::vector<Eigen::Vector3d> points_in_table;  // mm
  std::vector<Track> tracks;                     // one a point, every view in each

  // Standard deviation of a coordinate: noise, and what rounding adds to it. [px]
  double sigma_px = 0.0;
};

// The same for the same seed, on every machine. Any thread.
SyntheticTurn syntheticTurn(const SyntheticTurnOptions& options, std::uint64_t seed);

}  // namespace gyre
