// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_sketch.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/calib/targets/standard_targets.h"

namespace gyre {
namespace {

std::map<int, int> facesOfClicks(const Target& target, const TargetSketch& sketch) {
  std::map<int, int> clicks;
  for (const TargetPoint& point : pointsOf(target)) {
    for (const int id : sketch.to_click) clicks[point.face] += point.corner_id == id ? 1 : 0;
  }
  std::erase_if(clicks, [](const auto& entry) { return entry.second == 0; });
  return clicks;
}

TEST(TargetSketch, AsksForTwoCornersOnEachOfThreeFacesOfTheCube) {
  const Target cube = standardTarget("cube")->target;
  const TargetSketch sketch = sketchOf(cube);
  EXPECT_EQ(sketch.faces.size(), 3U);
  ASSERT_EQ(sketch.to_click.size(), 6U);
  EXPECT_EQ(std::set<int>(sketch.to_click.begin(), sketch.to_click.end()).size(), 6U);
  const auto clicks = facesOfClicks(cube, sketch);
  ASSERT_EQ(clicks.size(), 3U);
  for (const auto& [face, count] : clicks) EXPECT_EQ(count, 2) << face;
}

TEST(TargetSketch, LiesInItsSquareWithTheTopUp) {
  const TargetSketch sketch = sketchOf(standardTarget("cube")->target);
  double top = 1.0;
  for (const auto& face : sketch.faces) {
    ASSERT_EQ(face.outline.size(), 4U);
    for (const Eigen::Vector2d& place : face.outline) {
      EXPECT_GE(place.minCoeff(), -1e-9);
      EXPECT_LE(place.maxCoeff(), 1.0 + 1e-9);
    }
  }
  // The first corner of the top face lies higher in the drawing than any of the sides' middles.
  for (const auto& corner : sketch.corners) top = std::min(top, corner.place.y());
  EXPECT_LT(top, 0.35);
}

TEST(TargetSketch, AsksForNothingThatDoesNotTell) {
  EXPECT_TRUE(sketchOf({}).to_click.empty());
  EXPECT_TRUE(sketchOf(standardTarget("flat")->target).to_click.empty());  // one face alone
  EXPECT_TRUE(sketchOf(standardTarget("ring")->target).corners.empty());
}

}  // namespace
}  // namespace gyre
