// Finds a target with a person's help: six clicked corners show where it is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/calib/match/find_target.h"

namespace gyre {

struct CornerClick {
  int corner_id = 0;                                // of the target
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // raw picture coordinates
};

struct ClickOptions {
  // How far from where it is predicted a corner may be found. [px], 1 .. 50
  double snap_px = 8.0;
  // The camera when it is known; else its focal length is found from the clicks, with the principal
  // point in the middle of the picture.
  std::optional<CameraModel> camera;

  Result<void> validate() const;
};

// Everything of the target that the picture shows. The clicks give pose and focal length; all
// corners of faces that look at the camera are predicted from these and snapped to the nearest
// saddle; pose and focal length follow anew from what was found, without what is off by more than
// three median deviations, and so on once more.
//
// Fails with a sentence when there are fewer than six clicks, when an id is no corner of the target
// or was clicked twice, when the clicks are all on one face (the focal length would be a guess:
// give the camera), when they do not fit the target, and when the picture shows too few corners.
Result<FoundTarget> targetFromClicks(const cv::Mat& image, const Target& target,
                                     std::span<const CornerClick> clicks,
                                     const ClickOptions& options = {});

}  // namespace gyre
