// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/correlation.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

// shift_px moves the pattern to the right.
cv::Mat patternPicture(double shift_px, double gain = 1.0, double offset = 0.0) {
  cv::Mat grey(60, 80, CV_8U);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const double value = 128 + 100 * test::pattern((column - shift_px) / 4.0, row / 4.0, 3);
      grey.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>(gain * value + offset);
    }
  }
  return grey;
}

TEST(Correlation, IsOneForThePatchItselfWhateverBrightnessAndContrast) {
  const auto patch = samplePatch(patternPicture(0), {40, 30});
  const auto dimmed = samplePatch(patternPicture(0, 0.5, 20), {40, 30});
  ASSERT_TRUE(patch && dimmed);
  EXPECT_NEAR(correlate(*patch, *patch), 1.0F, 1e-5F);
  EXPECT_NEAR(correlate(*patch, *dimmed), 1.0F, 1e-3F);
  EXPECT_NEAR(correlateAt(*patch, patternPicture(0), 40, 30), 1.0F, 1e-5F);
}

TEST(Correlation, FollowsAShiftBelowAPixel) {
  const auto still = samplePatch(patternPicture(0), {40, 30});
  const auto moved = samplePatch(patternPicture(0.4), {40.4, 30});
  const auto missed = samplePatch(patternPicture(0.4), {42.4, 30});
  ASSERT_TRUE(still && moved && missed);
  EXPECT_GT(correlate(*still, *moved), 0.995F);
  EXPECT_LT(correlate(*still, *missed), 0.9F);
}

TEST(Correlation, IsMinusOneForTheNegative) {
  const auto patch = samplePatch(patternPicture(0), {40, 30});
  const auto negative = samplePatch(patternPicture(0, -1.0, 255), {40, 30});
  ASSERT_TRUE(patch && negative);
  EXPECT_NEAR(correlate(*patch, *negative), -1.0F, 1e-2F);
}

TEST(Correlation, HasNoAnswerOnFlatGroundOrAcrossTheEdge) {
  const cv::Mat flat(60, 80, CV_8U, cv::Scalar(90));
  EXPECT_FALSE(samplePatch(flat, {40, 30}));
  EXPECT_FALSE(samplePatch(patternPicture(0), {3, 30}));
  EXPECT_FALSE(samplePatch(patternPicture(0), {40, 55}));
  const auto patch = samplePatch(patternPicture(0), {40, 30});
  EXPECT_EQ(correlateAt(*patch, flat, 40, 30), -1.0F);
  EXPECT_EQ(correlateAt(*patch, flat, 2, 30), -1.0F);
}

}  // namespace
}  // namespace gyre
