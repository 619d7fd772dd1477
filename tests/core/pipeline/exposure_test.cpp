// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/exposure.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace gyre {
namespace {

TEST(Exposure, CountsWhatHoldsNoDetail) {
  cv::Mat image(100, 200, CV_8UC3, cv::Scalar(120, 130, 140));
  image(cv::Rect(0, 0, 50, 100)).setTo(cv::Scalar(20, 30, 255));  // one channel is full
  image(cv::Rect(180, 0, 20, 100)).setTo(cv::Scalar(2, 3, 4));
  const Exposure exposure = exposureOf(image);
  EXPECT_DOUBLE_EQ(exposure.too_bright, 0.25);
  EXPECT_DOUBLE_EQ(exposure.too_dark, 0.1);
}

TEST(Exposure, FindsNothingWrongWithAGoodPicture) {
  const cv::Mat image(40, 60, CV_8UC3, cv::Scalar(0, 0, 100));  // pure red, not black
  EXPECT_EQ(exposureOf(image).too_bright, 0.0);
  EXPECT_EQ(exposureOf(image).too_dark, 0.0);
}

TEST(Exposure, TakesAPictureThatIsAllWhite) {
  EXPECT_EQ(exposureOf(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(255))).too_bright, 1.0);
}

TEST(Exposure, LooksAtAnAreaAlone) {
  cv::Mat image(100, 200, CV_8UC3, cv::Scalar(120, 130, 140));
  image(cv::Rect(0, 0, 50, 100)).setTo(cv::Scalar::all(255));
  cv::Mat area = cv::Mat::zeros(image.size(), CV_8U);
  area(cv::Rect(0, 0, 100, 50)).setTo(255);
  EXPECT_DOUBLE_EQ(exposureOf(image, area).too_bright, 0.5);
  EXPECT_EQ(exposureOf(image, cv::Mat::zeros(image.size(), CV_8U)).too_bright, 0.0);
}

TEST(Exposure, AdvisesByWhatIsLost) {
  EXPECT_EQ(exposureAdvice({0.04, 0.05}), "");
  EXPECT_NE(exposureAdvice({0.06, 0.0}).find("dim the light"), std::string::npos);
  EXPECT_NE(exposureAdvice({0.0, 0.2}).find("add light"), std::string::npos);
}

}  // namespace
}  // namespace gyre
