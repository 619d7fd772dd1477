// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/polygon_clip.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/sim/convex_body.h"

namespace gyre {
namespace {

using Eigen::Vector2d;

const std::vector<Vector2d> kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(PolygonClip, KeepsThePartInside) {
  EXPECT_EQ(clipped(kSquare, {Vector2d::UnitX(), 0.5}),
            (std::vector<Vector2d>{{0, 0}, {0.5, 0}, {0.5, 2}, {0, 2}}));
}

TEST(PolygonClip, KeepsAllOrNothing) {
  EXPECT_EQ(clipped(kSquare, {Vector2d::UnitX(), 2.0}), kSquare);
  EXPECT_TRUE(clipped(kSquare, {Vector2d::UnitX(), -1.0}).empty());
  EXPECT_TRUE(clipped({}, {Vector2d::UnitX(), 1.0}).empty());
}

TEST(ConvexHull, CoversABoxOutward) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, 2 * ((i >> 1) & 1), 3 * ((i >> 2) & 1));
  corners.emplace_back(0.5, 1.0, 1.5);
  const auto hull = convexHull(corners);
  // Each side is covered by all four triangles of its corners.
  EXPECT_EQ(hull.size(), 24U);
  for (const auto& [a, b, c] : hull) {
    EXPECT_GT((b - a).cross(c - a).dot(a - corners.back()), 0.0);
  }
}

TEST(ConvexHull, IsEmptyForAPlane) {
  EXPECT_TRUE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).empty());
}

}  // namespace
}  // namespace gyre
