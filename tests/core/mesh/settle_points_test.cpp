// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/settle_points.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

KdTree treeOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return KdTree(std::move(positions));
}

double rmsOffSphere(const PointCloud& cloud, double radius_mm) {
  double squared = 0.0;
  for (const Point& point : cloud.points) {
    squared += std::pow(point.position.norm() - radius_mm, 2);
  }
  return std::sqrt(squared / static_cast<double>(cloud.points.size()));
}

TEST(SettlePoints, LeavesAnExactSphereWhereItIs) {
  const PointCloud sphere = test::sphereCloud(4000, 20.0);
  const auto settled = settlePoints(sphere, treeOf(sphere), {});
  ASSERT_TRUE(settled);
  EXPECT_EQ(settled->points.size(), 4000U);
  EXPECT_LT(rmsOffSphere(*settled, 20.0), 0.004);  // 0.3 % of the spacing: the fit's ridge
}

TEST(SettlePoints, QuietsNoise) {
  PointCloud sphere = test::sphereCloud(4000, 20.0);
  test::addNoise(sphere, 0.1, 9);
  const auto settled = settlePoints(sphere, treeOf(sphere), {});
  ASSERT_TRUE(settled);
  EXPECT_GT(settled->points.size(), 3950U);
  EXPECT_LT(rmsOffSphere(*settled, 20.0), 0.06);  // 24 weighted neighbours for 6 unknowns
}

TEST(SettlePoints, LeavesOutOutliers) {
  PointCloud sphere = test::sphereCloud(4000, 20.0);
  for (std::size_t i = 0; i < 4000; i += 100) sphere.points[i].position *= 1.1;
  const auto settled = settlePoints(sphere, treeOf(sphere), {});
  ASSERT_TRUE(settled);
  EXPECT_EQ(settled->points.size(), 3960U);
  EXPECT_LT(rmsOffSphere(*settled, 20.0), 0.05);
}

TEST(SettlePoints, KeepsTheSidesOfAThinWallApart) {
  PointCloud wall;
  Random random(6);
  for (int i = 0; i < 4000; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    wall.points.push_back(test::surfacePoint(
        {random.uniform(0, 30), random.uniform(0, 30), 0.2 * side}, {0, 0, side}));
  }
  const auto settled = settlePoints(wall, treeOf(wall), {});
  ASSERT_TRUE(settled);
  ASSERT_EQ(settled->points.size(), 4000U);
  for (const Point& point : settled->points) {
    EXPECT_NEAR(point.position.z(), 0.2 * point.normal.z(), 1e-9);
  }
}

TEST(SettlePoints, LeavesLonePointsAndStopsWhenAsked) {
  PointCloud lone;
  lone.points.push_back(test::surfacePoint({1, 2, 3}, {0, 0, 1}));
  EXPECT_EQ(settlePoints(lone, treeOf(lone), {})->points.size(), 1U);
  EXPECT_TRUE(settlePoints({}, treeOf({}), {})->points.empty());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(settlePoints(lone, treeOf(lone), Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
