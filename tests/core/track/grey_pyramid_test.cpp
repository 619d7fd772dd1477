// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/grey_pyramid.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/random.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

cv::Mat noisy(double sigma, double texture) {
  Random random(4);
  cv::Mat grey(240, 320, CV_8U);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      // Texture on the right half only.
      const double pattern =
          column > 160 ? texture * test::pattern(column / 12.0, row / 12.0, 3) : 0.0;
      grey.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(128 + pattern + sigma * random.gaussian());
    }
  }
  return grey;
}

TEST(EstimateNoiseSigma, MeasuresWhiteNoise) {
  // The tenth percentile of block means lies a little below the mean: 15 % are allowed.
  EXPECT_NEAR(estimateNoiseSigma(noisy(2.0, 0.0)), 2.0, 0.3);
  EXPECT_NEAR(estimateNoiseSigma(noisy(5.0, 0.0)), 5.0, 0.75);
}

TEST(EstimateNoiseSigma, IsNotFooledByTexture) {
  EXPECT_NEAR(estimateNoiseSigma(noisy(2.0, 80.0)), 2.0, 0.3);
}

TEST(EstimateNoiseSigma, LooksOnlyWhereItIsTold) {
  cv::Mat grey = noisy(4.0, 0.0);
  grey.colRange(0, 160).setTo(0);
  cv::Mat area = cv::Mat::zeros(grey.size(), CV_8U);
  area.colRange(170, 320).setTo(255);
  EXPECT_NEAR(estimateNoiseSigma(grey, area), 4.0, 0.6);
}

TEST(EstimateNoiseSigma, NeverSaysZero) {
  EXPECT_GT(estimateNoiseSigma(cv::Mat(64, 64, CV_8U, cv::Scalar(7))), 0.0);
  EXPECT_GT(estimateNoiseSigma(cv::Mat(3, 3, CV_8U, cv::Scalar(7))), 0.0);
}

}  // namespace
}  // namespace gyre
