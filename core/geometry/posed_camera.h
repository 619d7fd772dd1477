// A camera and where it stood when it took a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

// As if the camera had gone round the object: the table frame turns with the table.
struct PosedCamera {
  CameraModel intrinsics;
  Rigid3 cam_from_table;

  Eigen::Vector3d centreInTable() const { return cam_from_table.inverse().translation; }  // mm
};

}  // namespace gyre
