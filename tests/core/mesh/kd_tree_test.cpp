// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/kd_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

std::vector<Eigen::Vector3d> randomPoints(std::size_t count) {
  Random random(1);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& point : points) {
    point = {random.uniform(), random.uniform(), random.uniform()};
  }
  return points;
}

TEST(KdTree, FindsWhatLookingAtAllPointsFinds) {
  const std::vector<Eigen::Vector3d> points = randomPoints(2000);
  const KdTree tree(points);
  for (const Eigen::Vector3d& place : randomPoints(50)) {
    std::vector<double> squared;
    for (const Eigen::Vector3d& point : points) squared.push_back((point - place).squaredNorm());
    std::sort(squared.begin(), squared.end());
    const auto nearest = tree.nearest(place, 7);
    ASSERT_EQ(nearest.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(nearest[i].squared_mm2, squared[i]);

    const auto within = tree.within(place, 0.1);
    const auto expected = std::upper_bound(squared.begin(), squared.end(), 0.1 * 0.1);
    EXPECT_EQ(within.size(), static_cast<std::size_t>(expected - squared.begin()));
  }
}

TEST(KdTree, GivesAllPointsWhenAskedForMore) {
  EXPECT_EQ(KdTree(randomPoints(5)).nearest({0, 0, 0}, 9).size(), 5U);
  EXPECT_TRUE(KdTree(randomPoints(5)).nearest({0, 0, 0}, 0).empty());
  EXPECT_TRUE(KdTree({}).nearest({0, 0, 0}, 3).empty());
  EXPECT_TRUE(KdTree({}).within({0, 0, 0}, 3).empty());
}

TEST(KdTree, OrdersPointsInOnePlaceByIndex) {
  const KdTree tree(std::vector<Eigen::Vector3d>(100, Eigen::Vector3d(1, 2, 3)));
  const auto nearest = tree.nearest({1, 2, 3}, 4);
  ASSERT_EQ(nearest.size(), 4U);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(nearest[i].index, i);
  EXPECT_EQ(tree.within({1, 2, 3}, 0.0).size(), 100U);
}

}  // namespace
}  // namespace gyre
