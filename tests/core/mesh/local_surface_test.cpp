// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/local_surface.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

KdTree treeOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return KdTree(std::move(positions));
}

TEST(FitLocalSurface, FollowsASphere) {
  const KdTree sphere = treeOf(test::sphereCloud(4000, 10.0));
  const Eigen::Vector3d place = sphere.point(1234);
  const auto surface = fitLocalSurface(sphere, place, sphere.nearest(place, 24));
  ASSERT_TRUE(surface);
  EXPECT_NEAR(std::abs(surface->normal.dot(place) / 10.0), 1.0, 1e-4);
  EXPECT_NEAR(surface->foot.norm(), 10.0, 0.002);
  EXPECT_LT(surface->residual_mm, 0.005);
  // Away from a ball's outward normal the surface falls by d^2 / 2R.
  const double outward = surface->normal.dot(place) > 0.0 ? 1.0 : -1.0;
  EXPECT_NEAR(outward * surface->bending.trace() / 2.0, -0.1, 0.01);
}

TEST(FitLocalSurface, HalvesTheNoise) {
  PointCloud noisy = test::sphereCloud(4000, 10.0);
  test::addNoise(noisy, 0.05, 7);
  const KdTree points = treeOf(noisy);
  double squared = 0.0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto found =
        fitLocalSurface(points, points.point(i), points.nearest(points.point(i), 24));
    ASSERT_TRUE(found);
    squared += std::pow(found->foot.norm() - 10.0, 2);
  }
  EXPECT_LT(std::sqrt(squared / 4000.0), 0.03);  // 24 weighted neighbours for 6 unknowns
}

TEST(FitLocalSurface, GivesThePlaneOfThreePoints) {
  const KdTree points({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  const auto surface = fitLocalSurface(points, {0, 0, 1}, points.nearest({0, 0, 1}, 3));
  ASSERT_TRUE(surface);
  EXPECT_NEAR(std::abs(surface->normal.z()), 1.0, 1e-9);
  EXPECT_NEAR(surface->foot.z(), 1.0, 1e-9);
}

TEST(FitLocalSurface, GivesNothingForLinesAndSinglePlaces) {
  const KdTree line({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  EXPECT_FALSE(fitLocalSurface(line, {0, 0, 0}, line.nearest({0, 0, 0}, 4)));
  EXPECT_FALSE(fitLocalSurface(line, {0, 0, 0}, line.nearest({0, 0, 0}, 2)));
  const KdTree same(std::vector<Eigen::Vector3d>(5, Eigen::Vector3d(1, 1, 1)));
  EXPECT_FALSE(fitLocalSurface(same, {1, 1, 1}, same.nearest({1, 1, 1}, 5)));
}

}  // namespace
}  // namespace gyre
