// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/axis_from_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

Rigid3 camFromBase() {
  return {Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 0.3).normalized()).toRotationMatrix(),
          {10.0, 20.0, 350.0}};
}

PoseSeries turning(double noise_rad, std::uint64_t seed) {
  Random random(seed);
  const Rigid3 table_from_piece{
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix(),
      {25.0, -10.0, 5.0}};
  PoseSeries poses;
  for (int k = 0; k < 24; ++k) {
    Rigid3 pose = camFromTable(camFromBase(), radFromDeg(15.0) * k) * table_from_piece;
    const Eigen::Vector3d turn =
        noise_rad * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
    if (turn.norm() > 0.0) {
      pose.rotation =
          Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose.rotation;
    }
    poses.push_back(pose);
  }
  return poses;
}

double missedBy(const AxisInCam& axis) {
  const Eigen::Vector3d truth = camFromBase().rotation.col(2);
  return truth.cross(axis.direction).norm();
}

TEST(AxisFromPoses, IsExactForExactPoses) {
  const auto axis = axisFromPoses({turning(0.0, 1)}, 0.06);
  ASSERT_TRUE(axis);
  EXPECT_LT(missedBy(*axis), 1e-9);
  const Eigen::Vector3d off = axis->point - camFromBase().translation;
  EXPECT_LT(off.cross(axis->direction).norm(), 1e-6);
  EXPECT_NEAR(axis->point.dot(axis->direction), 0.0, 1e-6);
}

TEST(AxisFromPoses, AveragesNoiseAndBearsFlippedPoses) {
  PoseSeries poses = turning(0.005, 2);
  // Small flat pieces are now and then seen turned over.
  for (const std::size_t k : {std::size_t{4}, std::size_t{13}}) {
    poses[k]->rotation =
        poses[k]->rotation * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()).toRotationMatrix();
  }
  const auto axis = axisFromPoses({poses}, 0.06);
  ASSERT_TRUE(axis);
  EXPECT_LT(missedBy(*axis), 0.005);  // the noise of one pose
}

TEST(AxisFromPoses, RefusesWhatDoesNotTurn) {
  EXPECT_FALSE(axisFromPoses({}, 0.06));
  EXPECT_FALSE(axisFromPoses({{Rigid3{}, Rigid3{}, std::nullopt}}, 0.06));
}

TEST(AnglesFromPoses, ChainsPiecesThatShareViews) {
  PoseSeries early = turning(0.0, 1);
  PoseSeries late = early;
  for (std::size_t k = 14; k < 24; ++k) early[k].reset();
  for (std::size_t k = 0; k < 10; ++k) late[k].reset();
  const auto angles = anglesFromPoses({early, late}, camFromBase().rotation.col(2));
  for (std::size_t k = 0; k < 24; ++k) {
    ASSERT_TRUE(angles[k]);
    EXPECT_NEAR(wrapped(*angles[k] - radFromDeg(15.0) * static_cast<double>(k)), 0.0, 1e-9);
  }
}

TEST(AnglesFromPoses, LeavesOutWhatNothingJoins) {
  PoseSeries early = turning(0.0, 1);
  PoseSeries late = early;
  for (std::size_t k = 12; k < 24; ++k) early[k].reset();
  for (std::size_t k = 0; k < 13; ++k) late[k].reset();
  const auto angles = anglesFromPoses({early, late}, camFromBase().rotation.col(2));
  EXPECT_TRUE(angles[5]);
  EXPECT_FALSE(angles[12]);
  EXPECT_FALSE(angles[20]);
}

}  // namespace
}  // namespace gyre
