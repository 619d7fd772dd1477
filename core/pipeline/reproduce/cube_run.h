// One run of the cube experiment: pictures, calibrations, corners.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/scan/calibration.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"
#include "core/sim/rig.h"

namespace gyre {

// The calibrations that are compared, in the order of the table's columns.
enum class CubeWay { kPlacedExactly, kPlacedByHand, kWholeTurn };
inline constexpr std::array<CubeWay, 3> kCubeWays = {CubeWay::kPlacedExactly,
                                                     CubeWay::kPlacedByHand, CubeWay::kWholeTurn};

struct CubeError {
  double calibration_mm = 0.0;     // mean distance of a point from its rays
  double reconstruction_mm = 0.0;  // mean distance of a point from the true corner
  int corners = 0;
};

// What one rendered cube gave: its corners in a row of pictures, 1.8 deg apart, and in a whole
// turn.
class CubeRun {
 public:
  // Renders and finds; fails when a picture does not show the cube.
  static Result<CubeRun> make(const RigSettings& rig, int views, const Task& task);

  Result<Calibration> calibrate(CubeWay way, const Task& task) const;

  // Corners from the first so many views. The paper's ways believe the commanded angles.
  CubeError measure(const Calibration& calibration, CubeWay way, int views) const;

 private:
  RigSettings rig_;
  Target target_;
  std::vector<Eigen::Vector3d> corners_in_table_;  // the truth
  std::vector<TargetView> row_;
  std::vector<TargetView> turn_;
};

}  // namespace gyre
