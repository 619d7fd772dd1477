// Cameras that look at the table's middle from all around, for tests of what pictures show.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/geometry/turntable_pose.h"

namespace gyre::test {

// 640 x 480 pixels; 100 mm fill 300 pixels at 400 mm.
inline CameraModel plainCamera() {
  return {.width_px = 640,
          .height_px = 480,
          .fx = 1200.0,
          .fy = 1200.0,
          .cx = 319.5,
          .cy = 239.5,
          .k1 = -0.05};
}

// From this far, so high above the horizon, towards the place in the table frame.
inline Rigid3 lookAt(const Eigen::Vector3d& target_in_table, double distance_mm, double up_rad) {
  const Eigen::Vector3d back(std::cos(up_rad), 0.0, std::sin(up_rad));
  Rigid3 cam_from_table;
  const Eigen::Vector3d right(0.0, 1.0, 0.0);
  cam_from_table.rotation.row(0) = right;
  cam_from_table.rotation.row(1) = (-back).cross(right);
  cam_from_table.rotation.row(2) = -back;
  cam_from_table.translation =
      Eigen::Vector3d(0.0, 0.0, distance_mm) - cam_from_table.rotation * target_in_table;
  return cam_from_table;
}

// So many views of one turn.
inline std::vector<Rigid3> turnOfViews(const Rigid3& cam_from_table, int views) {
  std::vector<Rigid3> poses;
  for (int i = 0; i < views; ++i) {
    poses.push_back(camFromTable(cam_from_table, kTurn_rad * i / views));
  }
  return poses;
}

}  // namespace gyre::test
