// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/common_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

constexpr double kTolerance_px = 0.6;
const Eigen::Vector2d kSize_px(1280.0, 960.0);

SharedMotion truth() {
  SharedMotion motion;
  motion.shift_px = {0.8, -0.5};
  motion.stretch = 2e-4;
  motion.turn_rad = -6e-4;
  return motion;
}

std::vector<ImageMotion> motionsOf(const SharedMotion& motion, int count, double sigma_px) {
  Random random(7);
  std::vector<ImageMotion> motions;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d place(random.uniform(-640, 640), random.uniform(-480, 480));
    const Eigen::Vector2d noise(sigma_px * random.gaussian(), sigma_px * random.gaussian());
    motions.push_back({place, motion.at(place) + noise});
  }
  return motions;
}

TEST(SharedMotion, IsExactForExactMotions) {
  const auto found = sharedMotion(motionsOf(truth(), 40, 0.0), kTolerance_px);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->shift_px - truth().shift_px).norm(), 0.0, 1e-12);
  EXPECT_NEAR(found->stretch, truth().stretch, 1e-14);
  EXPECT_NEAR(found->turn_rad, truth().turn_rad, 1e-14);
  EXPECT_EQ(found->sharing, 40U);
  EXPECT_NEAR(found->rmsPx(kSize_px), std::hypot(0.9434, 6.3246e-4 * 461.88), 1e-3);
}

TEST(SharedMotion, KnowsItsOwnUncertaintyUnderNoise) {
  const int kMotions = 100;
  const double kSigma_px = 0.05;
  const auto found = sharedMotion(motionsOf(truth(), kMotions, kSigma_px), kTolerance_px);
  ASSERT_TRUE(found);
  // A mean of n values is n^-1/2 as uncertain as one.
  const double expected = kSigma_px / std::sqrt(kMotions);
  EXPECT_NEAR(std::sqrt(found->covariance(0, 0)), expected, 0.25 * expected);
  EXPECT_LT((found->shift_px - truth().shift_px).norm(), 4.0 * expected);
  EXPECT_NEAR(found->rmsSigmaPx(kSize_px), 2.0 * expected, 0.5 * expected);
}

TEST(SharedMotion, IsThatOfTheMajority) {
  std::vector<ImageMotion> motions = motionsOf({}, 60, 0.03);
  SharedMotion walking;
  walking.shift_px = {14.0, 1.0};
  for (const ImageMotion& each : motionsOf(walking, 40, 0.03)) motions.push_back(each);
  const auto found = sharedMotion(motions, kTolerance_px);
  ASSERT_TRUE(found);
  EXPECT_LT(found->rmsPx(kSize_px), 0.03);
  EXPECT_EQ(found->sharing, 60U);
  EXPECT_FALSE(found->shares.back());
}

TEST(SharedMotion, HoldsNearAndFarTogetherWhenTheCameraMovedAside) {
  std::vector<ImageMotion> motions;
  for (const ImageMotion& each : motionsOf({}, 50, 0.0)) {
    const double nearness = 0.8 + 0.4 * (each.place.y() + 480.0) / 960.0;  // the desk comes nearer
    motions.push_back({each.place, nearness * Eigen::Vector2d(6.0, 0.0)});
  }
  const auto found = sharedMotion(motions, kTolerance_px);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sharing, 50U);
  EXPECT_NEAR(found->shift_px.x(), 6.0, 0.3);
}

TEST(SharedMotion, IsNothingForFewOrForOnePlace) {
  EXPECT_FALSE(sharedMotion({}, kTolerance_px));
  EXPECT_FALSE(sharedMotion(motionsOf(truth(), 3, 0.0), kTolerance_px));
  EXPECT_FALSE(sharedMotion(std::vector<ImageMotion>(10), kTolerance_px));
}

}  // namespace
}  // namespace gyre
