// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/turntable_pose.h"

#include <Eigen/Geometry>

namespace gyre {

Rigid3 baseFromTable(double table_angle_rad) {
  return {Eigen::AngleAxisd(table_angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          Eigen::Vector3d::Zero()};
}

Rigid3 camFromTable(const Rigid3& cam_from_table_at_zero, double table_angle_rad) {
  return cam_from_table_at_zero * baseFromTable(table_angle_rad);
}

}  // namespace gyre
