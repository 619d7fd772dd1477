// Blur in pixels is told whatever the edges are like, and not told where there are none.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/edge_width.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

const cv::Size kSize(320, 240);

cv::Mat everywhere() { return cv::Mat(kSize, CV_8U, cv::Scalar(255)); }

// Discs of different brightness, blurred by so much, with noise of so much.
cv::Mat discs(double blur_px, double noise_sigma) {
  constexpr int kFiner = 4;  // drawn finer than it is seen
  cv::Mat fine(kSize * kFiner, CV_32FC3, cv::Scalar::all(90));
  cv::RNG random(7);
  for (int i = 0; i < 60; ++i) {
    const cv::Point at(random.uniform(0, fine.cols), random.uniform(0, fine.rows));
    cv::circle(fine, at, kFiner * random.uniform(12, 30), cv::Scalar::all(random.uniform(40, 210)),
               cv::FILLED);
  }
  cv::GaussianBlur(fine, fine, {}, kFiner * blur_px);
  cv::Mat seen;
  cv::resize(fine, seen, kSize, 0, 0, cv::INTER_AREA);
  cv::Mat noise(kSize, CV_32FC3);
  random.fill(noise, cv::RNG::NORMAL, 0.0, noise_sigma);
  seen += noise;
  cv::Mat image;
  seen.convertTo(image, CV_8U);
  return image;
}

class EdgeWidth : public testing::TestWithParam<double> {};

TEST_P(EdgeWidth, IsTheBlurOfCleanEdges) {
  const auto width = edgeWidthPx(discs(GetParam(), 0.0), everywhere());
  ASSERT_TRUE(width.has_value());
  EXPECT_NEAR(*width, GetParam(), 0.25 + 0.1 * GetParam());
}

TEST_P(EdgeWidth, IsTheBlurOfNoisyEdges) {
  const auto width = edgeWidthPx(discs(GetParam(), 3.0), everywhere());
  ASSERT_TRUE(width.has_value());
  // Noise makes some crests look sharper than they are, and the sharpest are asked for.
  EXPECT_NEAR(*width, GetParam(), 0.35 + 0.2 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Blurs, EdgeWidth, testing::Values(0.8, 1.5, 2.5, 4.0));

TEST(EdgeWidthDegenerate, IsNotToldWithoutEdges) {
  const cv::Mat plain(kSize, CV_8UC3, cv::Scalar::all(120));
  EXPECT_FALSE(edgeWidthPx(plain, everywhere()).has_value());
  cv::Mat noisy(kSize, CV_8UC3);
  cv::RNG random(3);
  random.fill(noisy, cv::RNG::NORMAL, 120.0, 4.0);
  EXPECT_FALSE(edgeWidthPx(noisy, everywhere()).has_value());
}

TEST(EdgeWidthDegenerate, LooksAtTheAreaAlone) {
  EXPECT_FALSE(edgeWidthPx(discs(1.0, 0.0), cv::Mat::zeros(kSize, CV_8U)).has_value());
  cv::Mat image = discs(4.0, 0.0);
  const cv::Rect left(0, 0, 160, 240);
  discs(0.8, 0.0)(left).copyTo(image(left));
  cv::Mat right = everywhere();
  right(cv::Rect(0, 0, 175, 240)).setTo(0);
  const auto width = edgeWidthPx(image, right);
  ASSERT_TRUE(width.has_value());
  EXPECT_GT(*width, 3.0);
}

}  // namespace
}  // namespace gyre
