// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/square_lattice.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/random.h"

namespace gyre {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> board(int columns, int rows, double noise_mm) {
  Random random(3);
  const Eigen::Rotation2Dd turn(0.3);
  std::vector<Vector2d> points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      points.emplace_back(turn * Vector2d(7.5 * column - 4.0, 9.0 * row + 2.0));
      points.back() += noise_mm * Vector2d(random.gaussian(), random.gaussian());
    }
  }
  return points;
}

TEST(SquareLattice, FindsStepsAndPlaces) {
  const auto points = board(6, 5, 0.0);
  const auto fit = fitLattice(points);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->step.col(0).norm(), 7.5, 1e-9);
  EXPECT_NEAR(fit->step.col(1).norm(), 9.0, 1e-9);
  EXPECT_GT(fit->step.determinant(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d at = fit->origin + fit->step * fit->index[i].cast<double>().matrix();
    EXPECT_NEAR((at - points[i]).norm(), 0.0, 1e-9);
  }
}

TEST(SquareLattice, AveragesWhatWasMeasured) {
  const auto fit = fitLattice(board(6, 5, 0.01));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->step.col(0).norm(), 7.5, 0.01);  // 30 points, 0.01 mm each
}

TEST(SquareLattice, FindsNoneWhereThereIsNone) {
  EXPECT_FALSE(fitLattice({}));
  EXPECT_FALSE(fitLattice({{0, 0}, {1, 0}}));
  EXPECT_FALSE(fitLattice(board(6, 1, 0.0)));
  auto uneven = board(6, 5, 0.0);
  uneven[7] += Vector2d(0.2, 0.0);
  EXPECT_FALSE(fitLattice(uneven));
}

}  // namespace
}  // namespace gyre
