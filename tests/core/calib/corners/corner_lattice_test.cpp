// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/corner_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

// Corners of a board of unit squares, seen by a camera that looks at it slantwise.
std::vector<XCorner> boardCorners(int columns, int rows, double turn_rad) {
  std::vector<XCorner> corners;
  const auto pixelOf = [&](double x, double y) -> Eigen::Vector2d {
    const double u = std::cos(turn_rad) * x - std::sin(turn_rad) * y;
    const double v = std::sin(turn_rad) * x + std::cos(turn_rad) * y;
    const double depth = 1.0 + 0.03 * v;
    return {320.0 + 30.0 * u / depth, 240.0 + 22.0 * v / depth};
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      XCorner corner;
      corner.pixel = pixelOf(column, row);
      corner.strength = 100.0 - 0.01 * static_cast<double>(corners.size());
      corner.sigma_px = 0.05;
      corner.edge_a = (pixelOf(column + 0.1, row) - corner.pixel).normalized();
      corner.edge_b = (pixelOf(column, row + 0.1) - corner.pixel).normalized();
      // Bright along +-(a + b) for every second one.
      if (((column + row) & 1) != 0) corner.edge_b = -corner.edge_b;
      corners.push_back(corner);
    }
  }
  return corners;
}

TEST(CornerLattice, JoinsAllCornersOfABoardSeenAtAnyTurn) {
  for (int turn_deg = 0; turn_deg < 360; turn_deg += 20) {
    const auto corners = boardCorners(7, 5, radFromDeg(turn_deg));
    const auto lattices = growLattices(corners);
    ASSERT_EQ(lattices.size(), 1u) << turn_deg;
    EXPECT_EQ(lattices[0].nodes.size(), 35u);
    EXPECT_EQ(lattices[0].size.maxCoeff(), 7);
    EXPECT_EQ(lattices[0].size.minCoeff(), 5);
  }
}

TEST(CornerLattice, GoesRoundGapsAndIgnoresStrays) {
  auto corners = boardCorners(7, 5, 0.3);
  corners.erase(corners.begin() + 17);
  corners.erase(corners.begin() + 9);
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    XCorner stray;
    stray.pixel = {random.uniform(200.0, 600.0), random.uniform(150.0, 450.0)};
    stray.strength = 20.0;
    const double angle_rad = random.uniform(0.0, kTurn_rad);
    stray.edge_a = {std::cos(angle_rad), std::sin(angle_rad)};
    stray.edge_b = {-std::sin(angle_rad), std::cos(angle_rad)};
    corners.push_back(stray);
  }
  const auto lattices = growLattices(corners);
  ASSERT_FALSE(lattices.empty());
  int true_corners = 0;
  for (const auto& node : lattices[0].nodes) true_corners += static_cast<int>(node.corner < 33);
  EXPECT_GE(true_corners, 31);
  EXPECT_LE(lattices[0].nodes.size(), 35u);
}

TEST(CornerLattice, TellsWhichSquareIsDark) {
  // Bright along right + down at the first corner: the square right and down of it is bright.
  EXPECT_FALSE(growLattices(boardCorners(4, 4, 0.0)).front().origin_dark);
}

TEST(CornerLattice, FindsNoneWhereNoneIs) {
  EXPECT_TRUE(growLattices({}).empty());
  EXPECT_TRUE(growLattices(boardCorners(2, 2, 0.0)).empty());  // too few to be more than chance
  EXPECT_TRUE(growLattices(boardCorners(9, 1, 0.0)).empty());  // a line is no lattice
}

TEST(CornerLattice, RefusesOptionsOutOfRange) {
  CornerLatticeOptions options;
  options.snap = 0.6;
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace gyre
