// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/opencv_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

const std::vector<VideoMode>& someModes() {
  static const std::vector<VideoMode> kModes = {{640, 480, "YUYV", 30.0},
                                                {1920, 1080, "YUYV", 5.0},
                                                {2304, 1536, "YUYV", 2.0},
                                                {1920, 1080, "MJPG", 30.0}};
  return kModes;
}

OpenCvSourceOptions asked(const std::string& mode) { return cameraModeFromText(mode).value(); }

TEST(OpenCvSource, RefusesWhatIsNoCamera) {
  for (const char* camera : {"", "999", "/dev/null-camera", "nonsense", "/dev/shm"}) {
    const auto source = openOpenCvSource(camera);
    ASSERT_FALSE(source) << camera;
    EXPECT_EQ(source.error().code, Error::Code::kNotFound) << camera;
  }
}

TEST(OpenCvSource, RefusesADeviceThatIsNoCamera) {
  const auto source = openOpenCvSource("/dev/null");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, Error::Code::kBusy);
  EXPECT_FALSE(source.error().advice.empty());
}

TEST(CameraMode, ReadsSizeFormatAndRate) {
  const auto mode = cameraModeFromText("1920x1080@MJPG@30");
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->width_px, 1920);
  EXPECT_EQ(mode->height_px, 1080);
  EXPECT_EQ(mode->pixel_format, "MJPG");
  EXPECT_EQ(mode->frames_per_s, 30.0);
  EXPECT_TRUE(cameraModeFromText("640x480"));
  for (const char* text : {"", "640", "640x", "640x480@", "640x480@MJPEG", "x", "0x1F", "0x480"}) {
    EXPECT_FALSE(cameraModeFromText(text)) << text;
  }
}

TEST(ChooseMode, TakesTheLargestAtFivePicturesASecondByItself) {
  EXPECT_EQ(chooseMode(someModes(), {}).value(), (VideoMode{1920, 1080, "MJPG", 30.0}));
}

TEST(ChooseMode, TakesWhatIsAskedFor) {
  EXPECT_EQ(chooseMode(someModes(), asked("1920x1080@YUYV")).value().frames_per_s, 5.0);
  EXPECT_EQ(chooseMode(someModes(), asked("640x480")).value().pixel_format, "YUYV");
  EXPECT_EQ(chooseMode(someModes(), asked("1920x1080@MJPG@15")).value().frames_per_s, 15.0);
  EXPECT_EQ(chooseMode(someModes(), asked("2304x1536")).value().frames_per_s, 2.0);
}

TEST(ChooseMode, RefusesWhatIsNotThereAndTellsWhatIs) {
  for (const char* mode : {"1024x768", "640x480@MJPG", "640x480@YUYV@60"}) {
    const auto chosen = chooseMode(someModes(), asked(mode));
    ASSERT_FALSE(chosen) << mode;
    EXPECT_EQ(chosen.error().code, Error::Code::kRejected);
    EXPECT_THAT(chosen.error().advice, testing::HasSubstr("1920x1080@MJPG@30"));
  }
}

TEST(ChooseMode, LeavesItToADriverThatListsNone) {
  EXPECT_EQ(chooseMode({}, asked("1024x768")).value().width_px, 1024);
  EXPECT_EQ(chooseMode({}, {}).value(), VideoMode{});
}

TEST(KeepsMode, JudgesSizeAndFormatAndNotTheRate) {
  const VideoMode mode{1920, 1080, "MJPG", 30.0};
  EXPECT_TRUE(keepsMode(mode, {1920, 1080, "MJPG", 15.0}));
  EXPECT_TRUE(keepsMode({}, mode));
  EXPECT_FALSE(keepsMode(mode, {640, 480, "MJPG", 30.0}));
  EXPECT_FALSE(keepsMode(mode, {1920, 1080, "YUYV", 30.0}));
}

}  // namespace
}  // namespace gyre
