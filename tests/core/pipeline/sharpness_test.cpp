// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sharpness.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

cv::Mat chessboard() {
  cv::Mat image(64, 64, CV_8UC3);
  for (int v = 0; v < 64; ++v) {
    for (int u = 0; u < 64; ++u) {
      image.at<cv::Vec3b>(v, u) = cv::Vec3b::all((u / 8 + v / 8) % 2 == 0 ? 40 : 200);
    }
  }
  return image;
}

TEST(Sharpness, FallsWithEveryBlur) {
  const cv::Mat sharp = chessboard();
  cv::Mat soft;
  cv::GaussianBlur(sharp, soft, {}, 0.8);
  cv::Mat softer;
  cv::GaussianBlur(sharp, softer, {}, 2.0);
  EXPECT_GT(sharpnessOf(sharp), 2.0 * sharpnessOf(soft));
  EXPECT_GT(sharpnessOf(soft), 2.0 * sharpnessOf(softer));
}

TEST(Sharpness, IsNothingWithoutAnythingToSee) {
  EXPECT_EQ(sharpnessOf(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(7))), 0.0);
}

}  // namespace
}  // namespace gyre
