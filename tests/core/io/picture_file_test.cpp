// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/picture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

cv::Mat noise(int type) {
  cv::Mat image(48, 64, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65535 : 255);
  return image;
}

std::string encodedAs(const std::string& ending, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, image, bytes);
  return {bytes.begin(), bytes.end()};
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(WritePicture, KeepsEveryPixelUnderAnyName) {
  const TempDir dir;
  const cv::Mat image = noise(CV_8UC3);
  ASSERT_TRUE(writePicture(dir / "Ansicht ü 猫.png", image));
  const auto frame = readPicture(dir / "Ansicht ü 猫.png");
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_TRUE(same(frame->image_bgr, image));
  EXPECT_EQ(frame->name, "Ansicht ü 猫.png");
  EXPECT_EQ(frame->view, -1);
}

TEST(WritePicture, RefusesWhatIsNoPicture) {
  const TempDir dir;
  EXPECT_FALSE(writePicture(dir / "x.png", cv::Mat()));
  EXPECT_FALSE(std::filesystem::exists(dir / "x.png"));
}

TEST(ReadPicture, MakesEightBitColourOfEverything) {
  const TempDir dir;
  for (const int type : {CV_8UC1, CV_8UC4, CV_16UC1, CV_16UC3}) {
    const auto file = putFile(dir / "x.png", encodedAs(".png", noise(type)));
    const auto frame = readPicture(file);
    ASSERT_TRUE(frame) << frame.error().sentence();
    EXPECT_EQ(frame->image_bgr.type(), CV_8UC3);
    EXPECT_EQ(frame->image_bgr.size(), cv::Size(64, 48));
  }
}

TEST(ReadPicture, IgnoresTheRotationThatExifAsksFor) {
  const TempDir dir;
  const std::string jpeg = encodedAs(".jpg", noise(CV_8UC3));
  // APP1: "Exif", big-endian TIFF with one entry, orientation (0x0112) = 6: a quarter turn.
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  const auto file = putFile(dir / "x.jpg", jpeg.substr(0, 2) + exif + jpeg.substr(2));
  ASSERT_EQ(cv::imread(file.string(), cv::IMREAD_COLOR).size(), cv::Size(48, 64));
  EXPECT_EQ(readPicture(file)->image_bgr.size(), cv::Size(64, 48));
}

TEST(ReadPicture, RefusesCutAndDamagedPicturesByName) {
  const TempDir dir;
  for (const std::string ending : {".jpg", ".png", ".bmp", ".tif"}) {
    const std::string bytes = encodedAs(ending, noise(CV_8UC3));
    const auto file = putFile(dir / ("cut" + ending), bytes.substr(0, bytes.size() / 2));
    const auto frame = readPicture(file);
    ASSERT_FALSE(frame) << ending;
    EXPECT_EQ(frame.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(frame.error().what, HasSubstr("cut" + ending));
  }
  std::string png = encodedAs(".png", noise(CV_8UC3));
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 1);
  EXPECT_THAT(readPicture(putFile(dir / "bad.png", png)).error().what, HasSubstr("damaged"));
  EXPECT_THAT(readPicture(putFile(dir / "t.png", "text")).error().what, HasSubstr("no PNG"));
  EXPECT_EQ(readPicture(dir / "none.png").error().code, Error::Code::kNotFound);
}

TEST(ReadMask, TakesAbove127AsObject) {
  const TempDir dir;
  const cv::Mat grey = (cv::Mat_<unsigned char>(1, 4) << 0, 127, 128, 255);
  ASSERT_TRUE(writePicture(dir / "m.png", grey));
  const auto mask = readMask(dir / "m.png");
  ASSERT_TRUE(mask) << mask.error().sentence();
  EXPECT_TRUE(same(*mask, (cv::Mat_<unsigned char>(1, 4) << 0, 0, 255, 255)));
}

}  // namespace
}  // namespace gyre
