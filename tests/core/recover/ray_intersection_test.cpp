// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/ray_intersection.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gyre {
namespace {

// A back-rotated ray of a camera 350 mm from the axis and 100 mm up, at a table angle.
Ray rayAt(double angle_deg, const Eigen::Vector3d& point_in_table) {
  const double angle_rad = radFromDeg(angle_deg);
  const Eigen::Vector3d origin(350 * std::cos(angle_rad), -350 * std::sin(angle_rad), 100);
  return {origin, (point_in_table - origin).normalized()};
}

const Eigen::Vector3d kTruth(12.0, -7.0, 40.0);

TEST(IntersectTwoRays, RecoversAnExactPoint) {
  const auto point = intersectTwoRays(rayAt(0, kTruth), rayAt(20, kTruth));
  ASSERT_TRUE(point);
  EXPECT_LT((*point - kTruth).norm(), 1e-9);
}

TEST(IntersectTwoRays, GivesTheMiddleOfTheGapBetweenSkewRays) {
  const Ray along_x{{-10, 0, 1}, {1, 0, 0}};
  const Ray along_y{{0, -10, -1}, {0, 1, 0}};
  const auto point = intersectTwoRays(along_x, along_y);
  ASSERT_TRUE(point);
  EXPECT_LT(point->norm(), 1e-12);
}

TEST(IntersectTwoRays, RefusesTwoLooksFromTheSameStop) {
  EXPECT_FALSE(intersectTwoRays(rayAt(0, kTruth), rayAt(0, kTruth)));
  EXPECT_FALSE(intersectTwoRays(rayAt(0, kTruth), rayAt(1, kTruth)));
}

TEST(IntersectTwoRays, RefusesRaysThatMeetBehindTheCamera) {
  Ray away = rayAt(0, kTruth);
  away.direction = -away.direction;
  EXPECT_FALSE(intersectTwoRays(away, rayAt(20, kTruth)));
}

TEST(IntersectRays, RecoversAnExactPointFromThreeStops) {
  const std::vector<Ray> rays = {rayAt(0, kTruth), rayAt(15, kTruth), rayAt(30, kTruth)};
  const auto point = intersectRays(rays);
  ASSERT_TRUE(point);
  EXPECT_LT((*point - kTruth).norm(), 1e-9);
  EXPECT_NEAR(degFromRad(widestAngle(rays)), 30.0, 3.0);
}

TEST(IntersectRays, IsExactForSkewRaysByTheNormalEquations) {
  // Three mutually orthogonal lines, each 1 from the origin: by symmetry the minimum is known.
  const std::vector<Ray> rays = {
      {{0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}}};
  const auto point = intersectRays(rays);
  ASSERT_TRUE(point);
  EXPECT_LT((*point - Eigen::Vector3d(0.5, 0.5, 0.5)).norm(), 1e-12);
}

TEST(IntersectRays, RefusesFewerThanTwoAndParallelRays) {
  EXPECT_FALSE(intersectRays({}));
  const std::vector<Ray> one = {rayAt(0, kTruth)};
  EXPECT_FALSE(intersectRays(one));
  const std::vector<Ray> parallel = {rayAt(0, kTruth), rayAt(0, kTruth), rayAt(0, kTruth)};
  EXPECT_FALSE(intersectRays(parallel));
}

}  // namespace
}  // namespace gyre
