// The same spots of the object in pictures that lie apart, before anything is known of the rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/camera_model.h"
#include "core/pipeline/reconstruct.h"
#include "core/recover/turn_steps.h"
#include "core/track/view_matches.h"

namespace gyre {

// Matches of views in their order.
struct MatchedPictures {
  std::vector<std::vector<PixelMatch>> pairs;  // of each view with the next
  // Views so many apart are matched as well: small steps alone say little of their size.
  std::size_t stride = 1;
  std::vector<std::vector<PixelMatch>> wide;  // of view i with view i + stride; empty for stride 1
  std::vector<PixelMatch> closing;            // of the last view with the first

  // Of views `stride` apart, which are the pairs when no view is skipped.
  const std::vector<std::vector<PixelMatch>>& apart() const { return stride == 1 ? pairs : wide; }
};

// Finds spots in each picture, where its mask allows, and matches them (matchSpots). Fails when a
// picture cannot be read or the task is stopped. Progress tells view i of N.
Result<MatchedPictures> matchPictures(const std::vector<PictureView>& views, const Task& task);

// The same matches in normalised coordinates, without the lens' distortion.
std::vector<ViewMatch> undistorted(const CameraModel& camera, std::span<const PixelMatch> pixels);

}  // namespace gyre
