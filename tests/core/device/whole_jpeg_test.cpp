// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/whole_jpeg.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace gyre {
namespace {

std::vector<unsigned char> jpegOf(const cv::Mat& image_bgr) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image_bgr, bytes);
  return bytes;
}

std::vector<unsigned char> someJpeg() {
  return jpegOf(cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 120, 200)));
}

TEST(WholeJpeg, GivesThePicture) {
  const auto image_bgr = decodeWholeJpeg(someJpeg());
  ASSERT_TRUE(image_bgr) << image_bgr.error().sentence();
  EXPECT_EQ(image_bgr->size(), cv::Size(64, 48));
  EXPECT_NEAR(image_bgr->at<cv::Vec3b>(20, 20)[2], 200, 3);
}

TEST(WholeJpeg, TurnsGreyIntoColour) {
  EXPECT_EQ(decodeWholeJpeg(jpegOf(cv::Mat(8, 8, CV_8UC1, cv::Scalar(7))))->type(), CV_8UC3);
}

TEST(WholeJpeg, AllowsForFillBytesBehindTheEnd) {
  auto bytes = someJpeg();
  bytes.insert(bytes.end(), {'\r', '\n', 0, 0, 0, 0});
  EXPECT_TRUE(decodeWholeJpeg(bytes));
}

TEST(WholeJpeg, RefusesOneCutOffAtAnyByte) {
  const auto whole = someJpeg();
  for (std::size_t length = 0; length < whole.size() - 1; ++length) {
    const auto half = decodeWholeJpeg(std::span(whole).first(length));
    ASSERT_FALSE(half) << length;
    EXPECT_EQ(half.error().code, Error::Code::kIo);
  }
}

TEST(WholeJpeg, RefusesWhatIsNone) {
  EXPECT_FALSE(decodeWholeJpeg({}));
  const std::vector<unsigned char> marks = {0xff, 0xd8, 0xff, 0xd9};
  EXPECT_TRUE(isWholeJpeg(marks));
  EXPECT_FALSE(decodeWholeJpeg(marks));
}

}  // namespace
}  // namespace gyre
