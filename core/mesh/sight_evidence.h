// What cameras tell of free space.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry/ray.h"

namespace gyre {

// All in the table frame.
struct SightEvidence {
  std::vector<Eigen::Vector3d> camera_centres;  // of each view that points name. [mm]
  // Lines from a camera that meet nothing, as they end in the background of its picture: a list for
  // each picture, all from its camera. An outline may be wrong, so each picture counts once
  // wherever it speaks.
  std::vector<std::vector<Ray>> background;
};

}  // namespace gyre
