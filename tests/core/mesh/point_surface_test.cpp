// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_surface.h"

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

TEST(PointSurfaces, FallsAwayFromTheNormalOnABall) {
  const PointCloud cloud = ball(10.0, 0.0);
  for (const PointSurface& each : pointSurfaces(cloud)) {
    EXPECT_NEAR(meanCurvature(each.bending), -0.1, 0.01);
    EXPECT_NEAR((each.bending - each.bending.transpose()).norm(), 0.0, 1e-12);
    EXPECT_LT(each.scatter_mm, 0.005);
    EXPECT_NEAR(each.reach_mm, 1.5, 0.4);  // 24 of 4000 on a ball: a disc of radius 1.55 mm
  }
}

TEST(PointSurfaces, LiesInTheTangentPlaneAndFollowsTheNormalsSign) {
  PointCloud cloud = ball(10.0, 0.0);
  for (Point& point : cloud.points) point.normal *= -1.0;  // the inside of a bowl
  const auto surfaces = pointSurfaces(cloud);
  for (std::size_t i = 0; i < surfaces.size(); i += 37) {
    EXPECT_NEAR(meanCurvature(surfaces[i].bending), 0.1, 0.01);
    EXPECT_LT((surfaces[i].bending * cloud.points[i].normal).norm(), 0.01);
  }
}

// 24 points within 1.4 mm, each 0.01 mm off: some 0.01 mm of a rise over 1 mm^2.
TEST(PointSurfaces, IsSteadyUnderNoise) {
  double squares = 0.0;
  double scatter_mm = 0.0;
  const auto surfaces = pointSurfaces(ball(10.0, 0.01));
  for (const PointSurface& each : surfaces) {
    squares += std::pow(meanCurvature(each.bending) + 0.1, 2);
    scatter_mm += each.scatter_mm / static_cast<double>(surfaces.size());
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(surfaces.size())), 0.03);
  EXPECT_NEAR(scatter_mm, 0.01, 0.002);
}

TEST(PointSurfaces, IsNoneWhereThePointsDoNotTell) {
  EXPECT_TRUE(pointSurfaces({}).empty());
  PointCloud two;
  two.points.resize(2);
  two.points[1].position = {1, 0, 0};
  for (Point& point : two.points) point.normal = Eigen::Vector3d::UnitZ();
  for (const PointSurface& each : pointSurfaces(two)) {
    EXPECT_TRUE(each.bending.isZero());
    EXPECT_EQ(each.scatter_mm, 0.0);
  }
}

}  // namespace
}  // namespace gyre
