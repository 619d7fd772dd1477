// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/video_file_camera.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "core/base/clock.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr int kPictures = 12;
constexpr int kGreyStep = 20;  // a compressed grey tells its picture by this

std::filesystem::path putVideo(const std::filesystem::path& file) {
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         10.0, {64, 48});
  for (int i = 0; i < kPictures; ++i) {
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(kGreyStep * i)));
  }
  return file;
}

int numberOf(const FramePtr& frame) {
  return (frame->image_bgr.at<cv::Vec3b>(20, 20)[0] + kGreyStep / 2) / kGreyStep;
}

TEST(VideoFileCamera, ShowsOnePictureAfterTheOther) {
  const TempDir dir;
  auto camera = openVideoFile(putVideo(dir / "Drehung 猫 %02d.avi"));
  ASSERT_TRUE(camera) << camera.error().sentence();
  EXPECT_EQ((*camera)->info().width_px, 64);
  for (int i = 0; i < kPictures; ++i) {
    const double asked_s = steadySeconds();
    const auto frame = (*camera)->grabAfter(asked_s, {});
    ASSERT_TRUE(frame) << frame.error().sentence();
    EXPECT_EQ(numberOf(*frame), i);
    EXPECT_EQ((*camera)->grabAfter(asked_s, {}).value(), *frame) << "looked at twice";
  }
  const auto none = (*camera)->grabAfter(steadySeconds(), {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Error::Code::kNotFound);
  EXPECT_THAT(none.error().what, HasSubstr("All 12 pictures"));
}

TEST(VideoFileCamera, GoesToAnyPictureForwardsAndBack) {
  const TempDir dir;
  auto camera = openVideoFile(putVideo(dir / "turn.avi"));
  ASSERT_TRUE(camera);
  for (const int index : {7, 2, 11, 0}) {
    (*camera)->goTo(static_cast<std::size_t>(index));
    EXPECT_EQ(numberOf((*camera)->grabAfter(steadySeconds(), {}).value()), index);
  }
  (*camera)->goTo(99);
  EXPECT_FALSE((*camera)->grabAfter(steadySeconds(), {}));
}

TEST(VideoFileCamera, SaysThatAVideoIsCutOff) {
  const TempDir dir;
  const auto file = dir / "turn.avi";
  {
    cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, {320, 240});
    cv::Mat noise(240, 320, CV_8UC3);
    for (int i = 0; i < kPictures; ++i) {
      cv::randu(noise, 0, 255);
      writer.write(noise);
    }
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  auto camera = openVideoFile(file);
  ASSERT_TRUE(camera) << camera.error().sentence();
  Result<FramePtr> frame = (*camera)->grabAfter(steadySeconds(), {});
  int good = 0;
  for (; frame && good < kPictures; ++good) frame = (*camera)->grabAfter(steadySeconds(), {});
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, Error::Code::kInvalidInput);
  EXPECT_THAT(frame.error().what, HasSubstr("cut off"));
}

TEST(VideoFileCamera, RefusesInWordsWhatIsNoVideo) {
  const TempDir dir;
  EXPECT_EQ(openVideoFile(dir / "nowhere.mp4").error().code, Error::Code::kNotFound);
  EXPECT_THAT(openVideoFile(putFile(dir / "empty.mp4", "")).error().what, HasSubstr("is empty"));
  EXPECT_THAT(openVideoFile(putFile(dir / "text.mp4", "no video at all")).error().what,
              HasSubstr("cannot be read as a video"));
  EXPECT_FALSE(openVideoFile(dir.path()));
}

TEST(VideoFileCamera, StopsOnRequest) {
  const TempDir dir;
  auto camera = openVideoFile(putVideo(dir / "turn.avi"));
  ASSERT_TRUE(camera);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ((*camera)->grabAfter(0.0, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
