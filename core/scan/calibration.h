// What must be known of camera and table to measure.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

struct Calibration {
  CameraModel camera;
  std::optional<Rigid3> cam_from_table;  // at table angle 0; none after a hand-held calibration
};

}  // namespace gyre
