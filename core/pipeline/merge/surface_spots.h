// Spots of a measured surface that can be told again in another scan of the same object.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/merge/pass_input.h"
#include "core/scan/frame.h"

namespace gyre {

struct SurfaceSpots {
  std::vector<Eigen::Vector3d> places;   // in the pass's table frame, mm
  std::vector<Eigen::Vector3d> normals;  // unit, outward
  cv::Mat descriptors;                   // a row a spot
};

// Spots (findSpots) of some pictures spread over the turn, each redrawn level (LevelPicture), on
// the pass's surface: not where it is met at a slant, near its outline, or where no camera saw it.
// One place of the object comes once for each picture in which it is a spot. Fails when a picture
// is missing or of another size, or when stopped.
Result<SurfaceSpots> findSurfaceSpots(const PassInput& pass, const Task& task);

}  // namespace gyre
