// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/opencv_source.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/device/streaming_camera.h"
#include "tests/support/mjpeg_server.h"

namespace gyre {
namespace {

using namespace std::chrono_literals;

// A grey that tells the number of the picture, well apart for JPEG.
cv::Mat numbered(int number) { return {48, 64, CV_8UC3, cv::Scalar::all((number % 60) * 4)}; }

OpenCvSourceOptions brief() {
  OpenCvSourceOptions options;
  options.open_timeout_s = 1.0;
  options.read_timeout_s = 0.5;
  return options;
}

TEST(OpenCvSource, ReadsANetworkCamera) {
  test::MjpegServer server(numbered, 50.0);
  auto source = openOpenCvSource(server.url(), brief());
  ASSERT_TRUE(source) << source.error().sentence();
  EXPECT_EQ((*source)->info().width_px, 64);
  EXPECT_EQ((*source)->info().height_px, 48);
  ASSERT_TRUE((*source)->grab(1.0));
  const auto frame = (*source)->retrieve();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->image_bgr.type(), CV_8UC3);
  EXPECT_EQ(frame->view, -1);
  EXPECT_GT(frame->time_s, 0.0);
}

TEST(OpenCvSource, GivesFreshPicturesThroughAStreamingCameraAfterAPause) {
  std::atomic<int> newest{0};
  test::MjpegServer server(
      [&](int number) {
        newest = number;
        return numbered(number);
      },
      50.0);
  StreamingCamera camera(openOpenCvSource(server.url(), brief()).value());
  std::this_thread::sleep_for(300ms);
  const int asked_at = newest;
  const auto frame = camera.grabAfter(steadySeconds(), {});
  ASSERT_TRUE(frame) << frame.error().sentence();
  const int number = ((*frame)->image_bgr.at<cv::Vec3b>(20, 20)[0] + 2) / 4;
  EXPECT_GT(number, asked_at % 60);
}

TEST(OpenCvSource, SaysThatAStreamHasNoControls) {
  test::MjpegServer server(numbered, 50.0);
  const CameraInfo info = openOpenCvSource(server.url(), brief()).value()->lockControls();
  ASSERT_EQ(info.controls.size(), 4U);
  EXPECT_FALSE(info.controls[0].locked);
  EXPECT_FALSE(info.controls[0].remark.empty());
}

TEST(OpenCvSource, NoticesAFrozenAndAVanishedCamera) {
  for (const bool frozen : {true, false}) {
    test::MjpegServer server(numbered, 50.0);
    auto source = openOpenCvSource(server.url(), brief());
    ASSERT_TRUE(source);
    ASSERT_TRUE((*source)->grab(1.0));
    frozen ? server.freeze() : server.vanish();
    const double start_s = steadySeconds();
    Result<void> grabbed = (*source)->grab(1.0);
    for (int i = 0; i < 200 && grabbed; ++i) grabbed = (*source)->grab(1.0);
    ASSERT_FALSE(grabbed);
    EXPECT_EQ(grabbed.error().code, Error::Code::kGone);
    EXPECT_LT(steadySeconds() - start_s, 3.0);
  }
}

TEST(OpenCvSource, RefusesWhatIsNoCamera) {
  for (const char* camera : {"", "999", "/dev/null-camera", "nonsense", "/dev/shm"}) {
    const auto source = openOpenCvSource(camera, brief());
    ASSERT_FALSE(source) << camera;
    EXPECT_EQ(source.error().code, Error::Code::kNotFound) << camera;
  }
}

TEST(OpenCvSource, SaysThatNothingListensAndHidesThePassword) {
  const auto source = openOpenCvSource("http://me:secret@127.0.0.1:9/video", brief());
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, Error::Code::kNotFound);
  EXPECT_EQ(source.error().sentence().find("secret"), std::string::npos);
  EXPECT_NE(source.error().what.find("http://127.0.0.1:9/video"), std::string::npos);
}

TEST(CameraMode, ReadsSizeFormatAndRate) {
  const auto mode = cameraModeFromText("1920x1080@MJPG@30");
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->width_px, 1920);
  EXPECT_EQ(mode->height_px, 1080);
  EXPECT_EQ(mode->pixel_format, "MJPG");
  EXPECT_EQ(mode->frames_per_s, 30.0);
  EXPECT_TRUE(cameraModeFromText("640x480"));
  for (const char* text : {"", "640", "640x", "640x480@", "640x480@MJPEG", "x", "0x1F"}) {
    EXPECT_FALSE(cameraModeFromText(text)) << text;
  }
}

}  // namespace
}  // namespace gyre
