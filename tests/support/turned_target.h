// A calibration target on the default rig's table, seen by an ideal detector with known noise.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/scan/calibration.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre::test {

// Lattices of 9 x 7 corners, 9 mm apart, on a slope of 40 deg, of 9 x 4 on its upright back, and of
// 4 x 3, 7 mm apart, on both sides.
Target wedgeTarget();
// A cube of 60 mm with 6 x 6 corners, 8 mm apart, on each face but the lower one.
Target cubeTarget();
// 9 x 7 corners, 9 mm apart, flat at z = 0.
Target flatTarget();
// Markers of the side, lying on the table in a ring of the radius.
Target ringTarget(int markers, double radius_mm, double side_mm);

struct TurnedTarget {
  explicit TurnedTarget(Target seen);

  Target target;
  std::vector<Eigen::Vector3d> true_points;  // one a point of the target, mm: bend these
  Rigid3 table_from_target;                  // a little off the axis and turned
  Calibration truth;                         // the default rig's
  std::vector<double> commanded_rad;         // 24 steps of 15 deg
  std::vector<double> true_rad;              // the same until changed
  double noise_px = 0.05;

  // What each picture shows: points of faces that the camera sees at less than 75 deg from their
  // normal and that lie in the picture.
  std::vector<TargetView> views(std::uint64_t seed) const;

  void setSteps(int views, double step_rad);
};

}  // namespace gyre::test
