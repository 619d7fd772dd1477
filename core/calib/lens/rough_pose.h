// Where a target is in front of a camera that is known roughly.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/known_point.h"

namespace gyre {

struct RoughPose {
  CameraModel camera;
  Rigid3 cam_from_target;
  double rms_px = 0.0;  // root mean square distance of the points from where they were seen
};

// What may change beside the pose.
enum class PoseFreedom { kPose, kFocal, kFocalAndK1 };

// Levenberg-Marquardt from a start that is nearly right; all points count alike. Returns nothing
// when there are fewer equations than unknowns, when a point is or comes to lie behind the camera,
// or when nothing is determined.
std::optional<RoughPose> refineRoughPose(std::span<const KnownPoint> points, const RoughPose& start,
                                         PoseFreedom freedom);

// From at least 4 points without a start. With focal freedom the camera gives the size of the
// picture, the principal point and the distortion; its focal length is only the first of several
// that are tried. Returns nothing when no camera sees the points so.
// Terzakis and Lourakis, "A Consistently Fast and Globally Optimal Solution to the
// Perspective-n-Point Problem" (2020), by OpenCV, then least squares.
std::optional<RoughPose> findRoughPose(std::span<const KnownPoint> points,
                                       const CameraModel& camera, PoseFreedom freedom);

// What is assumed of a camera of which nothing is known: square pixels, the principal point in the
// middle, about 45 degrees across, no distortion.
CameraModel unknownCamera(int width_px, int height_px);

}  // namespace gyre
