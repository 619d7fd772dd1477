// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/saddle_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <opencv2/core.hpp>

#include "core/calib/corners/picture_noise.h"
#include "tests/support/rendered_checker.h"

namespace gyre {
namespace {

const Eigen::Vector2d kCorner_px(40.27, 38.61);

Eigen::Matrix3d pixelFromBoard() {
  Eigen::Matrix3d pixel_from_board;
  pixel_from_board << 24.0, -5.0, kCorner_px.x(), 4.0, 22.0, kCorner_px.y(), 0.0, 0.0, 1.0;
  return pixel_from_board;
}

cv::Mat cornerPicture(double noise, std::uint64_t seed = 1) {
  CheckerPicture picture;
  picture.width_px = picture.height_px = 80;
  picture.noise = noise;
  picture.seed = seed;
  return renderPattern(picture, checkerPattern(pixelFromBoard()));
}

TEST(FitSaddle, ReachesTheCornerFromPixelsAway) {
  const cv::Mat blurred = blurredForSaddles(cornerPicture(0.0));
  for (const Eigen::Vector2d& miss : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, -0.4),
                                      Eigen::Vector2d(2, 2), Eigen::Vector2d(-2, 2)}) {
    const auto fit = fitSaddle(blurred, kCorner_px + miss, 6);
    ASSERT_TRUE(fit) << miss.transpose();
    EXPECT_LT((fit->pixel - kCorner_px).norm(), 0.01);
    EXPECT_NEAR(fit->contrast, 150.0, 5.0);
  }
}

TEST(FitSaddle, HasThePredictedErrorAtEachRadius) {
  for (const int radius_px : {3, 6}) {
    constexpr int kPictures = 60;
    double squares = 0.0;
    double predicted = 0.0;
    for (int i = 0; i < kPictures; ++i) {
      const cv::Mat blurred =
          blurredForSaddles(cornerPicture(5.0, static_cast<std::uint64_t>(i) + 1));
      const auto fit = fitSaddle(blurred, kCorner_px, radius_px, 5.0);
      ASSERT_TRUE(fit);
      squares += (fit->pixel - kCorner_px).squaredNorm();
      predicted += 2.0 * fit->sigma_px * fit->sigma_px;
    }
    // 120 coordinates give a variance to 13 %.
    EXPECT_NEAR(squares / predicted, 1.0, 0.4) << radius_px;
  }
}

TEST(FitSaddle, GivesNothingWhereThereIsNoSaddle) {
  const cv::Mat blurred = blurredForSaddles(cornerPicture(1.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fitSaddle(blurred, kCorner_px + Eigen::Vector2d(11, 10), 5));  // within a square
  EXPECT_FALSE(fitSaddle(blurred, kCorner_px + Eigen::Vector2d(12, 2), 3));   // on an edge
  EXPECT_FALSE(fitSaddle(blurred, {2, 2}, 6));                                // at the rim
  EXPECT_FALSE(fitSaddle(blurred, {-100, 1e9}, 6));
  EXPECT_FALSE(fitSaddle(blurred, {nan, 40}, 6));
  EXPECT_FALSE(fitSaddle(cv::Mat(), {40, 40}, 6));
  const cv::Mat plain = blurredForSaddles(cv::Mat(80, 80, CV_8U, cv::Scalar(9)));
  EXPECT_FALSE(fitSaddle(plain, {40, 40}, 6));
}

TEST(RefineSaddles, AnswersEveryGuessInItsPlace) {
  const std::vector<SaddleGuess> guesses = {{kCorner_px + Eigen::Vector2d(1, 1), 6},
                                            {{500, 500}, 6},
                                            {kCorner_px - Eigen::Vector2d(1, 0), 100}};
  const auto fits = refineSaddles(cornerPicture(2.0), guesses);
  ASSERT_EQ(fits.size(), 3U);
  ASSERT_TRUE(fits[0]);
  EXPECT_FALSE(fits[1]);
  ASSERT_TRUE(fits[2]);
  EXPECT_LT((fits[0]->pixel - kCorner_px).norm(), 0.06);  // 4 sigma
  EXPECT_LT((fits[0]->pixel - fits[2]->pixel).norm(), 0.005);
}

TEST(PictureNoise, MeasuresTheNoiseOfASquaredPicture) {
  for (const double noise : {1.0, 2.0, 5.0, 12.0}) {
    CheckerPicture picture;
    picture.width_px = picture.height_px = 240;
    picture.noise = noise;
    const cv::Mat grey = renderPattern(picture, checkerPattern(pixelFromBoard()));
    // Rounding adds 1/12 to the variance; edges on a fifth of the pixels lift the median.
    EXPECT_NEAR(pictureNoise(grey), std::sqrt(noise * noise + 1.0 / 12.0), 0.35 * noise);
  }
}

TEST(PictureNoise, IsThatOfRoundingWhereThereIsNone) {
  const double rounding = std::sqrt(1.0 / 12.0);
  EXPECT_DOUBLE_EQ(pictureNoise(cv::Mat()), rounding);
  EXPECT_DOUBLE_EQ(pictureNoise(cv::Mat(2, 2, CV_8U, cv::Scalar(3))), rounding);
  EXPECT_DOUBLE_EQ(pictureNoise(cv::Mat(50, 50, CV_8U, cv::Scalar(3))), rounding);
}

}  // namespace
}  // namespace gyre
