// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/tetrahedra.h"

#include <cmath>
#include <limits>
#include <stop_token>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/random.h"

namespace gyre {
namespace {

std::vector<Eigen::Vector3d> randomPoints(std::size_t count) {
  Random random(7);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  return points;
}

double sixfoldVolume(const Tetrahedra& tetrahedra, std::uint32_t cell) {
  const auto& [a, b, c, d] = tetrahedra.corners[cell];
  const auto& points = tetrahedra.points;
  return (points[b] - points[a]).cross(points[c] - points[a]).dot(points[d] - points[a]);
}

TEST(Delaunay, KnowsNeighboursFromBothSides) {
  const auto tetrahedra = delaunay(randomPoints(500), {});
  ASSERT_TRUE(tetrahedra);
  for (std::uint32_t cell = 0; cell < tetrahedra->cells(); ++cell) {
    for (std::size_t side = 0; side < 4; ++side) {
      const std::uint32_t next = tetrahedra->neighbours[cell][side];
      const std::uint32_t mirror = tetrahedra->mirrors[cell][side];
      ASSERT_EQ(tetrahedra->neighbours[next][mirror], cell);
      ASSERT_EQ(tetrahedra->mirrors[next][mirror], side);
    }
  }
}

TEST(Delaunay, FillsTheHullWithCellsOfPositiveVolumeAndEmptyBalls) {
  const auto tetrahedra = delaunay(randomPoints(60), {});
  ASSERT_TRUE(tetrahedra);
  for (std::uint32_t cell = 0; cell < tetrahedra->cells(); ++cell) {
    if (tetrahedra->isInfinite(cell)) continue;
    EXPECT_GT(sixfoldVolume(*tetrahedra, cell), 0.0);
    const auto& corners = tetrahedra->corners[cell];
    Eigen::Matrix3d rows;
    Eigen::Vector3d right;
    const Eigen::Vector3d& first = tetrahedra->points[corners[0]];
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& other = tetrahedra->points[corners[static_cast<std::size_t>(i) + 1]];
      rows.row(i) = (other - first).transpose();
      right[i] = (other.squaredNorm() - first.squaredNorm()) / 2.0;
    }
    const Eigen::Vector3d centre = rows.fullPivLu().solve(right);
    const double radius = (centre - first).norm();
    for (const auto& point : tetrahedra->points) {
      EXPECT_GT((point - centre).norm(), radius * (1.0 - 1e-9));
    }
  }
}

TEST(Delaunay, SidesLookOutOfTheirCell) {
  const auto tetrahedra = delaunay(randomPoints(100), {});
  ASSERT_TRUE(tetrahedra);
  for (std::uint32_t cell = 0; cell < tetrahedra->cells(); ++cell) {
    if (tetrahedra->isInfinite(cell)) continue;
    for (int side = 0; side < 4; ++side) {
      const auto [a, b, c] = tetrahedra->side(cell, side);
      const auto& points = tetrahedra->points;
      const auto& apex = points[tetrahedra->corners[cell][static_cast<std::size_t>(side)]];
      EXPECT_LT((points[b] - points[a]).cross(points[c] - points[a]).dot(apex - points[a]), 0.0);
      EXPECT_FALSE(tetrahedra->isInfinite(cell, side));
    }
  }
}

TEST(Delaunay, ListsTheCellsAroundEachPoint) {
  const auto tetrahedra = delaunay(randomPoints(200), {});
  const CellsAround around(*tetrahedra);
  std::size_t listed = 0;
  for (std::uint32_t point = 0; point < 200; ++point) {
    for (const std::uint32_t cell : around.of(point)) {
      const auto& corners = tetrahedra->corners[cell];
      EXPECT_NE(std::find(corners.begin(), corners.end(), point), corners.end());
      ++listed;
    }
  }
  std::size_t corners = 0;
  for (std::uint32_t cell = 0; cell < tetrahedra->cells(); ++cell) {
    corners += tetrahedra->isInfinite(cell) ? 3 : 4;
  }
  EXPECT_EQ(listed, corners);
}

TEST(Delaunay, TakesPointsThatCoincideAsOne) {
  auto points = randomPoints(50);
  points.push_back(points.front());
  const auto tetrahedra = delaunay(points, {});
  ASSERT_TRUE(tetrahedra);
  EXPECT_EQ(tetrahedra->points.size(), 51U);
  const CellsAround around(*tetrahedra);
  EXPECT_NE(around.of(0).empty(), around.of(50).empty());
}

TEST(Delaunay, RefusesWhatHasNoInside) {
  EXPECT_EQ(delaunay({}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(delaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}).error().code, Error::Code::kTooFew);
  std::vector<Eigen::Vector3d> flat;
  for (int i = 0; i < 30; ++i) flat.emplace_back(i % 6, (i * i) % 7, 0.0);
  EXPECT_EQ(delaunay(flat, {}).error().code, Error::Code::kTooFew);
  auto spoilt = randomPoints(10);
  spoilt[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(delaunay(spoilt, {}).error().code, Error::Code::kInvalidInput);
}

TEST(Delaunay, HearsAStop) {
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = delaunay(randomPoints(100), Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
