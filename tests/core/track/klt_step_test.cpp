// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/klt_step.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kWindow_px = 15;

GreyPyramid shifted(double dx, double dy) {
  cv::Mat bgr(200, 240, CV_8UC3);
  for (int row = 0; row < bgr.rows; ++row) {
    for (int column = 0; column < bgr.cols; ++column) {
      const auto value = cv::saturate_cast<std::uint8_t>(
          128 + 90 * test::pattern((column - dx) / 5.0, (row - dy) / 5.0, 3));
      bgr.at<cv::Vec3b>(row, column) = {value, value, value};
    }
  }
  return buildGreyPyramid(bgr, kWindow_px);
}

TEST(KltStep, FollowsAShiftToAFractionOfAPixel) {
  const GreyPyramid first = shifted(0, 0);
  const GreyPyramid second = shifted(3.37, -1.62);
  std::vector<KltMove> moves;
  for (int row = 30; row < 170; row += 10) {
    for (int column = 30; column < 210; column += 10) {
      const Eigen::Vector2f from(static_cast<float>(column), static_cast<float>(row));
      moves.push_back({from, from + Eigen::Vector2f(2, -1)});
    }
  }
  const auto outcomes = kltStep(first, second, moves, kWindow_px);
  ASSERT_EQ(outcomes.size(), moves.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    ASSERT_TRUE(outcomes[i].found);
    EXPECT_LT(outcomes[i].round_trip_px, 0.1F);
    const Eigen::Vector2f error = outcomes[i].to - moves[i].from - Eigen::Vector2f(3.37F, -1.62F);
    squares += error.squaredNorm();
  }
  // Pictures are rounded to whole grey levels; 0.05 px is several times what that leaves.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(moves.size())), 0.05);
}

TEST(KltStep, DoesNotComeBackFromAWrongPlace) {
  const GreyPyramid first = shifted(0, 0);
  const GreyPyramid second = shifted(0, 0);
  const std::vector<KltMove> moves = {{{60, 60}, {120, 90}}};
  const auto outcomes = kltStep(first, second, moves, kWindow_px);
  EXPECT_TRUE(!outcomes[0].found || outcomes[0].round_trip_px > 0.5F);
}

TEST(KltStep, TakesNoMoves) {
  const GreyPyramid picture = shifted(0, 0);
  EXPECT_TRUE(kltStep(picture, picture, {}, kWindow_px).empty());
}

}  // namespace
}  // namespace gyre
