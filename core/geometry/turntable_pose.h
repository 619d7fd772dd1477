// Where the camera is, seen from the turning table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/rigid3.h"

namespace gyre {

// base_from_table: the table turned by the angle about its z axis, counter-clockwise from above.
Rigid3 baseFromTable(double table_angle_rad);

// The camera's pose at a table angle, from its pose at angle 0:
//   cam_from_table(angle) = cam_from_table(0) * base_from_table(angle).
Rigid3 camFromTable(const Rigid3& cam_from_table_at_zero, double table_angle_rad);

}  // namespace gyre
