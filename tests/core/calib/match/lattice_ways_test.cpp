// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/lattice_ways.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/calib/targets/standard_targets.h"

namespace gyre {
namespace {

CornerLattice lattice(int columns, int rows) {
  CornerLattice made;
  made.size = {columns, rows};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      made.nodes.push_back({{column, row}, static_cast<int>(made.nodes.size())});
    }
  }
  return made;
}

// A face of the paper's cube: as many columns as rows.
TargetFace squareFace() { return facesOf(standardTarget("cube")->target).front(); }

TEST(LatticeWays, LaysAWholeSquareFaceInFourTurns) {
  const TargetFace face = squareFace();
  const int side = face.grid->columns;
  ASSERT_EQ(side, face.grid->rows);
  const auto ways = waysToLay(lattice(side, side), 3, face);
  const auto whole = std::count_if(ways.begin(), ways.end(), [&](const LatticeOnFace& way) {
    const Eigen::Vector2i first = cellOnFace(way, {0, 0});
    const Eigen::Vector2i last = cellOnFace(way, {side - 1, side - 1});
    return first.minCoeff() >= 0 && last.minCoeff() >= 0 && first.maxCoeff() < side &&
           last.maxCoeff() < side;
  });
  EXPECT_EQ(whole, 4);
  for (const LatticeOnFace& way : ways) EXPECT_EQ(way.lattice, 3);
}

TEST(LatticeWays, ShiftsASmallerLatticeToEveryPlace) {
  const TargetFace face = squareFace();
  const int side = face.grid->columns;
  // Six corners of which none may be missing: 2 x 3 lies in (side - 1)(side - 2) places each way.
  const auto ways = waysToLay(lattice(2, 3), 0, face);
  EXPECT_EQ(static_cast<int>(ways.size()), 4 * (side - 1) * (side - 2));
}

TEST(LatticeWays, TurnsClockwiseAndNeverMirrors) {
  const LatticeOnFace turned{0, 0, 1, {0, 0}};
  const Eigen::Vector2i right = cellOnFace(turned, {1, 0}) - cellOnFace(turned, {0, 0});
  const Eigen::Vector2i down = cellOnFace(turned, {0, 1}) - cellOnFace(turned, {0, 0});
  EXPECT_EQ(right.x() * down.y() - right.y() * down.x(), 1);
  EXPECT_NE(right, Eigen::Vector2i(1, 0));
}

TEST(LatticeWays, RefusesLatticesThatAreTooLargeAndFacesWithoutAGrid) {
  const TargetFace face = squareFace();
  const int side = face.grid->columns;
  EXPECT_TRUE(waysToLay(lattice(2 * side, side), 0, face).empty());
  TargetFace loose = face;
  loose.grid.reset();
  EXPECT_TRUE(waysToLay(lattice(2, 3), 0, loose).empty());
}

TEST(LatticeWays, TellDarkSquaresFromBrightOnes) {
  const TargetFace face = squareFace();
  CornerLattice seen = lattice(face.grid->columns, face.grid->rows);
  const auto ways = waysToLay(seen, 0, face);
  ASSERT_FALSE(ways.empty());
  const LatticeOnFace upright{0, face.index, 0, {0, 0}};
  const double as_seen = darkSquareMatch(seen, upright, face);
  seen.origin_dark = !seen.origin_dark;
  EXPECT_EQ(darkSquareMatch(seen, upright, face), -as_seen);
  EXPECT_NE(as_seen, 0.0);
}

}  // namespace
}  // namespace gyre
