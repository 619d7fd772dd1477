// The pose of a target, or of one piece of it, from a single picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

struct KnownPoint {
  Eigen::Vector3d position_in_target = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();               // raw
};

struct TargetPose {
  Rigid3 cam_from_target;
  double median_px = 0.0;  // distance of the points from where the pose puts them
};

// The pose that explains the points best; points that fit far worse than most lose their say.
// Coplanar points will do. Nothing with fewer than 4 points, or when all lie on a line.
std::optional<TargetPose> targetPose(const CameraModel& camera,
                                     const std::vector<KnownPoint>& points);

}  // namespace gyre
