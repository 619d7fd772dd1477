// The upright cylinder above the platter that the camera can see: where an object can be.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

struct SearchVolume {
  double radius_mm = 0.0;
  double z_min_mm = 0.0;
  double z_max_mm = 0.0;
};

// The cylinder around the axis outside of which a point of the table is out of the picture when it
// passes the outline on either side, bounded by the camera's own distance from the axis.
SearchVolume visibleVolume(const CameraModel& camera, const Rigid3& cam_from_table);

}  // namespace gyre
