// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/ray_walk.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

Tetrahedra randomCells(std::size_t count) {
  Random random(9);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  return *delaunay(std::move(points), {});
}

Eigen::Vector3d middleOf(const Tetrahedra& cells, std::uint32_t cell) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::uint32_t corner : cells.corners[cell]) middle += cells.points[corner] / 4.0;
  return middle;
}

TEST(WalkCells, EndsInTheCellThatHoldsTheEnd) {
  const Tetrahedra cells = randomCells(400);
  std::uint32_t start = 0;
  while (cells.isInfinite(start)) ++start;
  const Eigen::Vector3d from = middleOf(cells, start);
  for (std::uint32_t goal = 0; goal < cells.cells(); ++goal) {
    if (cells.isInfinite(goal) || goal == start) continue;
    const Eigen::Vector3d offset = middleOf(cells, goal) - from;
    double before_mm = 0.0;
    const auto end = walkCells(cells, start, Ray{from, offset.normalized()}, offset.norm(),
                               [&](std::uint32_t, const CellExit& exit) {
                                 EXPECT_GE(exit.distance_mm, before_mm - 1e-12);
                                 before_mm = exit.distance_mm;
                               });
    ASSERT_EQ(end, goal);
  }
}

TEST(WalkCells, LeavesTheHullWhenNothingStopsIt) {
  const Tetrahedra cells = randomCells(100);
  std::uint32_t start = 0;
  while (cells.isInfinite(start)) ++start;
  const auto end = walkCells(cells, start, Ray{middleOf(cells, start), Eigen::Vector3d::UnitY()},
                             1e300, [](std::uint32_t, const CellExit&) {});
  EXPECT_TRUE(cells.isInfinite(end));
}

TEST(CellTowards, FindsTheCellThatTheRayEnters) {
  const Tetrahedra cells = randomCells(200);
  const CellsAround around(cells);
  for (std::uint32_t point = 0; point < 200; ++point) {
    for (const std::uint32_t cell : around.of(point)) {
      if (cells.isInfinite(cell)) continue;
      const Eigen::Vector3d direction = (middleOf(cells, cell) - cells.points[point]).normalized();
      EXPECT_EQ(cellTowards(cells, around, point, direction), cell);
    }
  }
}

TEST(CellTowards, IsNothingWhereTheRayLeavesTheHull) {
  const Tetrahedra cells = *delaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {});
  const CellsAround around(cells);
  EXPECT_FALSE(cellTowards(cells, around, 0, -Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(cellTowards(cells, around, 0, Eigen::Vector3d::Ones().normalized()));
}

}  // namespace
}  // namespace gyre
