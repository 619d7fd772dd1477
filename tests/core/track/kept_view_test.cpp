// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/kept_view.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace gyre {
namespace {

void expectColour(const KeptView& view, const Eigen::Vector2d& pixel, const Rgb& colour) {
  const Rgb seen = colourAt(view, pixel);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(seen[channel], colour[channel], 3) << "channel " << channel;
  }
}

TEST(KeptView, GivesBackTheColoursOfThePicture) {
  cv::Mat picture(40, 60, CV_8UC3, cv::Scalar(20, 120, 220));  // blue, green, red
  picture.colRange(30, 60) = cv::Scalar(200, 40, 10);
  const KeptView view = keepView(picture, {});
  expectColour(view, {10.0, 10.0}, {220, 120, 20});
  expectColour(view, {50.0, 30.0}, {10, 40, 200});
}

TEST(KeptView, OfAnOddSizeAndOutsideGivesTheNearestPixel) {
  const cv::Mat picture(41, 61, CV_8UC3, cv::Scalar(20, 120, 220));
  const KeptView view = keepView(picture, {});
  expectColour(view, {60.4, 40.4}, {220, 120, 20});
  expectColour(view, {-5.0, 1000.0}, {220, 120, 20});
}

TEST(KeptView, IsHalfTheSizeOfThePicture) {
  const cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(1, 2, 3));
  const KeptView view = keepView(picture, {});
  EXPECT_EQ(view.grey.total() * view.grey.elemSize() + view.chroma.total() * view.chroma.elemSize(),
            picture.total() * picture.elemSize() / 2);
}

TEST(KeptView, MeasuresTheNoiseWhereTheObjectIs) {
  cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(100, 100, 100));
  cv::Mat grey(240, 160, CV_8U);
  cv::RNG random(1);
  random.fill(grey, cv::RNG::NORMAL, 100.0, 4.0);
  const cv::Mat planes[] = {grey, grey, grey};
  cv::Mat noisy;
  cv::merge(planes, 3, noisy);
  noisy.copyTo(picture.colRange(160, 320));
  cv::Mat mask(240, 320, CV_8U, cv::Scalar(0));
  mask.colRange(160, 320) = 255;
  EXPECT_NEAR(keepView(picture, mask).noise_sigma, 4.0, 1.0);
}

}  // namespace
}  // namespace gyre
