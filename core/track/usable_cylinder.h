// The upright cylinder about the axis that stays in the picture at every angle of the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/usable_cylinder.h"

namespace gyre {

// Whether the picture shows the whole circle about the axis, a hundredth of its width inside its
// edge: a point of the object at this radius and height then never leaves it.
bool circleStaysInPicture(const CameraModel& camera, const Rigid3& cam_from_table, double radius_mm,
                          double height_mm);

// Of all cylinders on the platter whose every point stays in the picture, the one of the largest
// volume. Nothing when the picture does not show the platter about the axis. An object may reach
// beyond it where it is narrower or lower than it.
std::optional<UsableCylinder> usableCylinder(const CameraModel& camera,
                                             const Rigid3& cam_from_table);

// A straight piece of a drawing in the picture. [px]
struct PictureLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

// Both rims of a cylinder and the axis in it, as the camera sees them; distorted as the picture is.
std::vector<PictureLine> drawnInPicture(const UsableCylinder& cylinder, const CameraModel& camera,
                                        const Rigid3& cam_from_table);

}  // namespace gyre
