// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_scatter.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/median.h"
#include "core/base/random.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

PointCloud ball(std::size_t count, double noise_mm) {
  PointCloud cloud = test::sphereCloud(count, 10.0);
  for (Point& point : cloud.points) point.normal = point.position.normalized();
  if (noise_mm > 0.0) test::addNoise(cloud, noise_mm, 3);
  return cloud;
}

TEST(PointScatter, IsTheNoiseOfIndependentPoints) {
  const auto scatter_mm = pointScatter(ball(4000, 0.02), {0.1, 5.0});
  EXPECT_NEAR(median(scatter_mm), 0.02, 0.002);
}

TEST(PointScatter, IsNearlyNoneOnASmoothSurface) {
  for (const double each : pointScatter(ball(4000, 0.0), {0.1, 5.0})) EXPECT_LT(each, 0.002);
}

// Every point four times, each copy with the same error: taken one by one, they would agree.
TEST(PointScatter, IsNotFooledByPointsThatErrAlike) {
  const PointCloud independent = ball(2000, 0.05);
  PointCloud copied;
  Random random(5);
  for (const Point& point : independent.points) {
    for (int copy = 0; copy < 4; ++copy) {
      copied.points.push_back(point);
      copied.points.back().position +=
          0.02 * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian())
                     .cross(point.normal);
    }
  }
  EXPECT_NEAR(median(pointScatter(copied, {0.3, 5.0})), 0.05, 0.007);
  EXPECT_LT(median(pointScatter(copied, {0.0, 5.0})), 0.047);
}

TEST(PointScatter, IsNoneWhereNeighboursAreTooFarToTell) {
  for (const double each : pointScatter(ball(100, 0.02), {0.1, 1.0})) EXPECT_EQ(each, 0.0);
  EXPECT_TRUE(pointScatter({}, {0.1, 1.0}).empty());
}

}  // namespace
}  // namespace gyre
