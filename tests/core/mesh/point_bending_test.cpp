// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_bending.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

PointCloud ball(double radius_mm, double noise_mm) {
  PointCloud cloud = test::sphereCloud(4000, radius_mm);
  for (Point& point : cloud.points) point.normal = point.position.normalized();
  if (noise_mm > 0.0) test::addNoise(cloud, noise_mm, 3);
  return cloud;
}

double meanCurvature(const Eigen::Matrix3d& bending) { return 0.5 * bending.trace(); }

TEST(PointBending, FallsAwayFromTheNormalOnABall) {
  const PointCloud cloud = ball(10.0, 0.0);
  for (const Eigen::Matrix3d& each : pointBending(cloud)) {
    EXPECT_NEAR(meanCurvature(each), -0.1, 0.01);
    EXPECT_NEAR((each - each.transpose()).norm(), 0.0, 1e-12);
  }
}

TEST(PointBending, LiesInTheTangentPlaneAndFollowsTheNormalsSign) {
  PointCloud cloud = ball(10.0, 0.0);
  for (Point& point : cloud.points) point.normal *= -1.0;  // the inside of a bowl
  const auto bending = pointBending(cloud);
  for (std::size_t i = 0; i < bending.size(); i += 37) {
    EXPECT_NEAR(meanCurvature(bending[i]), 0.1, 0.01);
    EXPECT_LT((bending[i] * cloud.points[i].normal).norm(), 0.01);
  }
}

// 24 points within 1.4 mm, each 0.01 mm off: some 0.01 mm of a rise over 1 mm^2.
TEST(PointBending, IsSteadyUnderNoise) {
  double squares = 0.0;
  const auto bending = pointBending(ball(10.0, 0.01));
  for (const Eigen::Matrix3d& each : bending) squares += std::pow(meanCurvature(each) + 0.1, 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(bending.size())), 0.03);
}

TEST(PointBending, IsNoneWhereThePointsDoNotTell) {
  EXPECT_TRUE(pointBending({}).empty());
  PointCloud two;
  two.points.resize(2);
  two.points[1].position = {1, 0, 0};
  for (Point& point : two.points) point.normal = Eigen::Vector3d::UnitZ();
  for (const Eigen::Matrix3d& each : pointBending(two)) EXPECT_TRUE(each.isZero());
}

}  // namespace
}  // namespace gyre
