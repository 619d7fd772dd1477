// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/thin_points.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

KdTree plane(std::size_t side, double spacing_mm) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t x = 0; x < side; ++x) {
    for (std::size_t y = 0; y < side; ++y) {
      points.emplace_back(spacing_mm * static_cast<double>(x), spacing_mm * static_cast<double>(y),
                          0.0);
    }
  }
  return KdTree(std::move(points));
}

TEST(LocalSpacing, IsTheSpacingOfAGrid) {
  // The eighth neighbour of a grid point is the diagonal one: sqrt(2 pi / 8) of the spacing.
  EXPECT_NEAR(localSpacing(plane(9, 2.0))[40], 2.0 * std::sqrt(2.0 * kPi / 8.0), 1e-12);
}

TEST(LocalSpacing, IsZeroForOnePoint) { EXPECT_EQ(localSpacing(plane(1, 1.0)).at(0), 0.0); }

TEST(SpacingQuantile, WeighsByArea) {
  const std::vector<double> spacing = {1, 1, 1, 1, 1, 1, 1, 1, 4};  // areas 8 and 16
  EXPECT_EQ(spacingQuantile(spacing, 0.3), 1.0);
  EXPECT_EQ(spacingQuantile(spacing, 0.5), 4.0);
  EXPECT_EQ(spacingQuantile({}, 0.5), 0.0);
}

TEST(ThinPoints, KeepsADistanceAndCoversTheRest) {
  const KdTree points = plane(40, 0.25);
  const std::vector<double> cost(points.size(), 1.0);
  const std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::UnitZ());
  const std::vector<double> radius_mm(points.size(), 1.0);
  const auto kept = thinPoints(points, {cost, normals, radius_mm});
  std::vector<Eigen::Vector3d> kept_points;
  for (const std::uint32_t i : kept) kept_points.push_back(points.point(i));
  const KdTree tree(kept_points);
  for (const Eigen::Vector3d& point : kept_points) {
    EXPECT_GT(tree.nearest(point, 2)[1].squared_mm2, 1.0);
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(tree.nearest(points.point(i), 1)[0].squared_mm2, 1.0);
  }
}

TEST(ThinPoints, PrefersTheBetterPoint) {
  const KdTree pair({{0, 0, 0}, {0.1, 0, 0}});
  const std::vector<double> cost = {0.5, 0.2};
  const std::vector<Eigen::Vector3d> normals(2, Eigen::Vector3d::UnitZ());
  const std::vector<double> radius_mm(pair.size(), 1.0);
  EXPECT_EQ(thinPoints(pair, {cost, normals, radius_mm}), std::vector<std::uint32_t>{1});
  EXPECT_TRUE(thinPoints(KdTree({}), {}).empty());
}

TEST(ThinPoints, KeepsADenseSideDenser) {
  const KdTree points = plane(40, 0.25);
  const std::vector<double> cost(points.size(), 1.0);
  const std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::UnitZ());
  std::vector<double> radius_mm;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    radius_mm.push_back(points.point(i).x() < 5.0 ? 0.1 : 1.2);
  }
  std::size_t dense = 0;
  std::size_t sparse = 0;
  for (const std::uint32_t i : thinPoints(points, {cost, normals, radius_mm})) {
    ++(points.point(i).x() < 5.0 ? dense : sparse);
  }
  EXPECT_GT(dense, 600U);
  EXPECT_LT(sparse, 100U);
}

TEST(ThinPoints, KeepsBothSidesOfAThinWall) {
  const KdTree pair({{0, 0, 0}, {0, 0, 0.1}, {0, 0, 0.1}});
  const std::vector<double> cost(3, 0.0);
  const std::vector<Eigen::Vector3d> normals = {-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(),
                                                -Eigen::Vector3d::UnitZ()};
  const std::vector<double> radius_mm(pair.size(), 1.0);
  EXPECT_EQ(thinPoints(pair, {cost, normals, radius_mm}), (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace gyre
