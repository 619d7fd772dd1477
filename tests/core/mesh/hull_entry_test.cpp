// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/hull_entry.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Tetrahedra ball() {
  std::vector<Eigen::Vector3d> points;
  for (const Point& point : test::sphereCloud(500, 10.0).points) points.push_back(point.position);
  return *delaunay(std::move(points), {});
}

TEST(HullEntry, IsTheFacetThatTheRayPasses) {
  const Tetrahedra cells = ball();
  const Eigen::Vector3d camera(0.0, -200.0, 40.0);
  const HullEntry hull(cells, camera);
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d target =
        9.0 *
        Eigen::Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    const Eigen::Vector3d direction = (target - camera).normalized();
    const auto entry = hull.of(direction);
    ASSERT_TRUE(entry);
    ASSERT_TRUE(cells.isInfinite(entry->cell));
    const auto [a, b, c] = cells.side(entry->cell, entry->side);
    Eigen::Matrix3d corners;
    corners << cells.points[a] - camera, cells.points[b] - camera, cells.points[c] - camera;
    const Eigen::Vector3d weights = corners.inverse() * direction;
    EXPECT_GE(weights.minCoeff(), -1e-9);
    const Eigen::Vector3d inward =
        (cells.points[b] - cells.points[a]).cross(cells.points[c] - cells.points[a]);
    EXPECT_GT(inward.dot(direction), 0.0);  // it is the near side
  }
}

TEST(HullEntry, IsNothingBesideTheHullBehindTheCameraAndFromInside) {
  const Tetrahedra cells = ball();
  const HullEntry hull(cells, {0.0, -200.0, 0.0});
  EXPECT_FALSE(hull.of(Eigen::Vector3d(0.1, 1.0, 0.0).normalized()));
  EXPECT_FALSE(hull.of(-Eigen::Vector3d::UnitY()));
  const HullEntry inside(cells, {0.0, 0.0, 0.0});
  EXPECT_FALSE(inside.of(Eigen::Vector3d::UnitX()));
}

}  // namespace
}  // namespace gyre
