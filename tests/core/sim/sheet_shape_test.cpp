// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sheet_shape.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Target bentTarget(const std::string& name, const RigSettings& rig) {
  const Target target = standardTarget(name)->target;
  return trueTarget(target, sheetsOf(target).value(), rig);
}

Vector3d normalOf(const Target& target, std::size_t face) {
  const auto at = [&](std::size_t i) {
    return target.corners[static_cast<std::size_t>(target.faces[face][i])].position_in_target;
  };
  const std::size_t last = target.faces[face].size() - 1;
  return (at(last) - at(0)).cross(at(1) - at(0)).normalized();
}

TEST(SheetShape, IsWhatTheTargetSaysWhenNothingIsWrong) {
  const Target target = standardTarget("wedge")->target;
  const Target truth = bentTarget("wedge", {});
  const auto meant = pointsOf(target);
  const auto found = pointsOf(truth);
  for (std::size_t i = 0; i < meant.size(); ++i) {
    EXPECT_NEAR((meant[i].position_in_target - found[i].position_in_target).norm(), 0.0, 1e-9);
  }
}

TEST(SheetShape, BowsWithoutStretchingThePaper) {
  const Target target = standardTarget("cube")->target;
  const auto sheets = sheetsOf(target).value();
  RigSettings rig;
  rig.target_bow_mm = 2.0;
  const SheetShape shape(sheets[0], rig, sheets.size());
  const Vector3d middle = shape.inTarget({0, 0});
  EXPECT_NEAR(middle.z(), 52.0, 1e-9);                   // the top of the cube, 2 mm up
  EXPECT_NEAR(shape.inTarget({25, 0}).z(), 50.0, 1e-9);  // its rim, 25 mm aside
  double length = 0.0;
  for (int i = 0; i < 500; ++i) {
    length += (shape.inTarget({0.05 * (i + 1), 3}) - shape.inTarget({0.05 * i, 3})).norm();
  }
  EXPECT_NEAR(length, 25.0, 1e-3);  // to the second order of the slope, here 0.16
}

TEST(SheetShape, LeansEachFaceByTheErrorOfItsFold) {
  RigSettings rig;
  rig.target_fold_error_deg = 1.0;
  const Target target = standardTarget("coded-cube")->target;
  const Target truth = bentTarget("coded-cube", rig);
  for (std::size_t face = 0; face < target.faces.size(); ++face) {
    const double turned_rad = std::acos(normalOf(target, face).dot(normalOf(truth, face)));
    EXPECT_NEAR(turned_rad, radFromDeg(1.0), 1e-6);
  }
}

TEST(SheetShape, StretchesTheFacesAsThePageWas) {
  RigSettings rig;
  rig.print_scale_right = 0.97;
  const Target target = standardTarget("wedge")->target;
  const Target truth = bentTarget("wedge", rig);
  const auto apart = [](const Target& of, std::size_t a, std::size_t b) {
    return (of.corners[a].position_in_target - of.corners[b].position_in_target).norm();
  };
  EXPECT_NEAR(apart(truth, 0, 1), 0.97 * apart(target, 0, 1), 1e-9);
  EXPECT_NEAR(apart(truth, 0, 6), apart(target, 0, 6), 1e-9);
  rig.print_scale_down = 0.97;
  const auto meant = pointsOf(target);
  const auto small = pointsOf(bentTarget("wedge", rig));
  for (std::size_t i = 0; i < meant.size(); ++i) {
    EXPECT_NEAR((0.97 * meant[i].position_in_target - small[i].position_in_target).norm(), 0.0,
                1e-9);
  }
}

}  // namespace
}  // namespace gyre
