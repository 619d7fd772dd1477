// Tsai's calibration: a camera and its pose from one view of known points, in closed form but for
// three parameters. The start of every refinement, and the paper's own way.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/calib/lens/tsai_model.h"
#include "core/scan/known_point.h"

namespace gyre {

// From at least 7 points that are not in one plane, with the principal point as given. Rotation,
// aspect, tx and ty follow from the radial alignment, free of focal length and distortion; then f,
// tz and kappa1 from a small least-squares problem. Needs no good start, but all of the noise goes
// into few parameters: refine the result.
//
// Fails with a sentence when points are too few, in one plane or on one line, not finite, mirrored
// (left-handed coordinates), or behind the camera.
// Tsai, "A Versatile Camera Calibration Technique" (1987), in homogeneous form.
Result<TsaiCamera> calibrateTsai(std::span<const KnownPoint> points,
                                 const Eigen::Vector2d& principal_px);

// The same from at least 5 points in one plane, any plane of the target frame, for square pixels
// (aspect 1). The plane must be tilted to the picture, 30 degrees or more for a good focal length;
// fails below 10. A mirrored plane cannot be told from one seen from its back.
Result<TsaiCamera> calibrateTsaiCoplanar(std::span<const KnownPoint> points,
                                         const Eigen::Vector2d& principal_px);

}  // namespace gyre
