// The pose of a target, or of one piece of it, from a single picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/known_point.h"

namespace gyre {

struct TargetPose {
  Rigid3 cam_from_target;
  double median_px = 0.0;  // distance of the points from where the pose puts them
};

// The pose that explains the points best; points that fit far worse than most lose their say.
// Coplanar points will do, points on a line leave a turn open. Nothing with fewer than 4 points.
std::optional<TargetPose> targetPose(const CameraModel& camera,
                                     const std::vector<KnownPoint>& points);

}  // namespace gyre
