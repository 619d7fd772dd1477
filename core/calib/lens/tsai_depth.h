// The second half of Tsai's method: what the radial alignment leaves open.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/calib/lens/tsai_model.h"

namespace gyre {

// A view with the principal point taken off, and what the radial alignment says of it.
struct RadialView {
  std::vector<Eigen::Vector3d> points_in_target;
  std::vector<Eigen::Vector2d> offsets_px;  // pixel minus principal point
  double aspect = 1.0;
  Rigid3 cam_from_target;  // tz unknown, left 0
};

// Focal length, tz and kappa1: a linear solution without distortion, then least squares on the
// undistorted picture. Fails with mirroredPoints() or undeterminedCamera().
Result<TsaiCamera> completeRadialView(const RadialView& view, const Eigen::Vector2d& principal_px);

Error undeterminedCamera();
Error mirroredPoints();

}  // namespace gyre
