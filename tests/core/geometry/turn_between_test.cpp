// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/turn_between.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

std::vector<Eigen::Vector3d> somePoints() {
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 30; ++i) {
    points.emplace_back(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(0, 80));
  }
  return points;
}

TEST(TurnBetween, FindsAnyTurnExactly) {
  const auto points = somePoints();
  for (const double angle_rad : {0.0, 1e-4, 1.0, -3.0}) {
    std::vector<Eigen::Vector3d> turned;
    for (const auto& point : points) turned.push_back(baseFromTable(angle_rad) * point);
    EXPECT_NEAR(turnBetween(points, turned), angle_rad, 1e-12);
    EXPECT_NEAR(turnBetween(turned, points), -angle_rad, 1e-12);
  }
}

// Thirty points about 35 mm off the axis, each 0.1 mm off: some 0.1 / 35 / sqrt(30) rad.
TEST(TurnBetween, AveragesNoise) {
  const auto points = somePoints();
  Random random(2);
  std::vector<Eigen::Vector3d> turned;
  for (const auto& point : points) {
    turned.push_back(baseFromTable(0.5) * point +
                     0.1 * Eigen::Vector3d(random.gaussian(), random.gaussian(), 1.0));
  }
  EXPECT_NEAR(turnBetween(points, turned), 0.5, 4.0 * 0.1 / 30.0 / std::sqrt(30.0));
}

TEST(TurnBetween, IsNoneWhereNoTurnIsBetter) {
  EXPECT_EQ(turnBetween({}, {}), 0.0);
  const std::vector<Eigen::Vector3d> on_axis = {{0, 0, 1}, {0, 0, 2}};
  EXPECT_EQ(turnBetween(on_axis, on_axis), 0.0);
}

}  // namespace
}  // namespace gyre
