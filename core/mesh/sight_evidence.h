// What cameras tell of where an object is, and where not.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry/posed_camera.h"
#include "core/geometry/ray.h"
#include "core/scan/frame.h"

namespace gyre {

// The object in one picture, and where the camera stood.
struct Outline {
  PosedCamera camera;
  cv::Mat mask;  // as a Silhouette's
};

// All in the table frame.
struct SightEvidence {
  std::vector<Eigen::Vector3d> camera_centres;  // of each view that points name. [mm]
  // Lines from a camera that meet nothing, as they end in the background of its picture: a list for
  // each picture, all from its camera. An outline may be wrong, so each picture counts once
  // wherever it speaks.
  std::vector<std::vector<Ray>> background;
  std::vector<Outline> outlines;
};

}  // namespace gyre
