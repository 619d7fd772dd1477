// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/turntable_pose.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/geometry/ray.h"

namespace gyre {
namespace {

TEST(TurntablePose, PositiveAnglesTurnCounterClockwiseSeenFromAbove) {
  const Eigen::Vector3d turned_in_base = baseFromTable(kPi / 2) * Eigen::Vector3d(1, 0, 5);
  EXPECT_LT((turned_in_base - Eigen::Vector3d(0, 1, 5)).norm(), 1e-12);
}

TEST(TurntablePose, PointsOnTheAxisStandStill) {
  const Rigid3 cam_from_table{
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      Eigen::Vector3d(3, 4, 500)};
  const Eigen::Vector3d on_axis(0, 0, 42);
  EXPECT_LT((camFromTable(cam_from_table, 1.1) * on_axis - cam_from_table * on_axis).norm(), 1e-12);
}

TEST(Rigid3, InverseCancels) {
  const Rigid3 b_from_a{
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      Eigen::Vector3d(3, 4, 500)};
  const Eigen::Vector3d x_in_a(1, -2, 3);
  EXPECT_LT((b_from_a.inverse() * (b_from_a * x_in_a) - x_in_a).norm(), 1e-12);
  EXPECT_TRUE(isRigid(b_from_a));
}

TEST(Rigid3, RecognisesReflectionsAndNonsense) {
  Rigid3 mirrored;
  mirrored.rotation(0, 0) = -1.0;
  EXPECT_FALSE(isRigid(mirrored));
  Rigid3 broken;
  broken.translation.x() = std::nan("");
  EXPECT_FALSE(isRigid(broken));
}

TEST(Ray, CrossesTheCylinderWhereGeometrySays) {
  const Ray ray{{-100, 0, 10}, {1, 0, 0}};
  const auto span = crossCylinder(ray, 30, 0, 50);
  ASSERT_TRUE(span);
  EXPECT_NEAR(span->from, 70, 1e-9);
  EXPECT_NEAR(span->to, 130, 1e-9);
  EXPECT_FALSE(crossCylinder(ray, 30, 20, 50));
  EXPECT_FALSE(crossCylinder({{-100, 31, 10}, {1, 0, 0}}, 30, 0, 50));
}

TEST(Ray, MeetsTheTableOnlyInFront) {
  const Ray down{{0, 0, 10}, {0, 0, -1}};
  EXPECT_TRUE(meetHorizontalPlane(down, 0));
  EXPECT_FALSE(meetHorizontalPlane(down, 20));
  EXPECT_NEAR(distanceToLine(down, {3, 4, -7}), 5.0, 1e-12);
}

}  // namespace
}  // namespace gyre
