// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/stream_source.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/device/streaming_camera.h"
#include "tests/support/mjpeg_server.h"

namespace gyre {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// A grey that tells the number of the picture, well apart for JPEG; 90 rows, so that a picture cut
// in half shows.
cv::Mat numbered(int number) { return {96, 64, CV_8UC3, cv::Scalar::all((number % 60) * 4 + 8)}; }

StreamSourceOptions brief() {
  StreamSourceOptions options;
  options.open_timeout_s = 1.0;
  options.read_timeout_s = 0.4;
  options.retry_s = 0.1;
  return options;
}

StreamingCameraOptions patient() {
  StreamingCameraOptions options;
  options.silence_s = 4.0;
  options.patience_s = 8.0;
  return options;
}

bool isOneGrey(const cv::Mat& image_bgr) {
  const cv::Mat values = image_bgr.clone().reshape(1);
  const auto [least, most] = std::minmax_element(values.begin<uchar>(), values.end<uchar>());
  return *most - *least < 8;
}

TEST(StreamSource, ReadsANetworkCamera) {
  test::MjpegServer server(numbered, 50.0);
  auto source = openStreamSource(server.url(), brief());
  ASSERT_TRUE(source) << source.error().sentence();
  EXPECT_EQ((*source)->info().width_px, 64);
  EXPECT_EQ((*source)->info().height_px, 96);
  ASSERT_TRUE((*source)->grab(1.0));
  const auto frame = (*source)->retrieve();
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_EQ(frame->image_bgr.type(), CV_8UC3);
  EXPECT_EQ(frame->image_bgr.size(), cv::Size(64, 96));
  EXPECT_EQ(frame->view, -1);
  EXPECT_GT(frame->time_s, 0.0);
}

TEST(StreamSource, GivesFreshPicturesThroughAStreamingCameraAfterAPause) {
  std::atomic<int> newest{0};
  test::MjpegServer server(
      [&](int number) {
        newest = number;
        return numbered(number);
      },
      50.0);
  StreamingCamera camera(openStreamSource(server.url(), brief()).value());
  std::this_thread::sleep_for(300ms);
  const int asked_at = newest;
  const auto frame = camera.grabAfter(steadySeconds(), {});
  ASSERT_TRUE(frame) << frame.error().sentence();
  const int number = ((*frame)->image_bgr.at<cv::Vec3b>(20, 20)[0] - 8 + 2) / 4;
  EXPECT_GT(number, asked_at % 60);
}

TEST(StreamSource, SaysThatAStreamHasNoControls) {
  test::MjpegServer server(numbered, 50.0);
  const CameraInfo info = openStreamSource(server.url(), brief()).value()->lockControls();
  ASSERT_EQ(info.controls.size(), 4U);
  EXPECT_FALSE(info.controls[0].locked);
  EXPECT_FALSE(info.controls[0].remark.empty());
}

TEST(StreamSource, SaysWithinItsDeadlineThatACameraIsSilentOrGone) {
  for (const bool frozen : {true, false}) {
    test::MjpegServer server(numbered, 50.0);
    auto source = openStreamSource(server.url(), brief());
    ASSERT_TRUE(source);
    ASSERT_TRUE((*source)->grab(1.0));
    frozen ? server.freeze() : server.vanish();
    const double start_s = steadySeconds();
    Result<void> grabbed = (*source)->grab(0.1);
    for (int i = 0; i < 400 && grabbed; ++i) grabbed = (*source)->grab(0.1);
    ASSERT_FALSE(grabbed);
    EXPECT_EQ(grabbed.error().code, Error::Code::kTimeout);
    EXPECT_THAT(grabbed.error().what, HasSubstr("sends no pictures any more"));
    EXPECT_LT(steadySeconds() - start_s, 3.0);
  }
}

TEST(StreamSource, ComesBackWithTheCamera) {
  test::MjpegServer server(numbered, 30.0);
  StreamingCamera camera(openStreamSource(server.url(), brief()).value(), patient());
  ASSERT_TRUE(camera.grabAfter(steadySeconds(), {}));
  for (const char* trouble : {"frozen", "gone", "dropped"}) {
    const std::string what = trouble;
    if (what == "frozen") server.freeze();
    if (what == "gone") server.vanish();
    if (what == "dropped") server.drop();
    std::jthread mender([&] {
      std::this_thread::sleep_for(700ms);
      server.thaw();
      server.comeBack();
    });
    const int clients = server.clients();
    std::this_thread::sleep_for(50ms);
    const double asked_s = steadySeconds();
    const auto frame = camera.grabAfter(asked_s, {});
    ASSERT_TRUE(frame) << trouble << ": " << frame.error().sentence();
    EXPECT_GE((*frame)->time_s, asked_s) << trouble;
    EXPECT_TRUE(isOneGrey((*frame)->image_bgr)) << trouble;
    for (int i = 0; i < 100 && server.clients() == clients; ++i) std::this_thread::sleep_for(20ms);
    EXPECT_GT(server.clients(), clients) << trouble;
  }
}

TEST(StreamSource, NamesWhatIsWrongWhenTheCameraStaysAwayAndGoesOnWhenItIsBack) {
  test::MjpegServer server(numbered, 30.0);
  StreamingCameraOptions options;
  options.silence_s = 1.0;
  options.patience_s = 2.0;
  StreamingCamera camera(openStreamSource(server.url(), brief()).value(), options);
  ASSERT_TRUE(camera.grabAfter(steadySeconds(), {}));
  server.vanish();
  Result<FramePtr> frame = camera.grabAfter(steadySeconds() + 0.5, {});
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, Error::Code::kTimeout);
  EXPECT_THAT(frame.error().sentence(), HasSubstr("is looked for again"));
  server.comeBack();
  for (int i = 0; i < 5 && !frame; ++i) frame = camera.grabAfter(steadySeconds(), {});
  EXPECT_TRUE(frame) << frame.error().sentence();
}

TEST(StreamSource, NeverShowsHalfAPicture) {
  test::MjpegServer server(numbered, 50.0);
  auto source = openStreamSource(server.url(), brief());
  ASSERT_TRUE(source);
  server.tear(10);
  int half = 0;
  for (int i = 0; i < 60; ++i) {
    if (!(*source)->grab(0.5)) continue;
    const auto frame = (*source)->retrieve();
    if (frame) {
      ASSERT_EQ(frame->image_bgr.size(), cv::Size(64, 96));
      ASSERT_TRUE(isOneGrey(frame->image_bgr));
    } else {
      EXPECT_EQ(frame.error().code, Error::Code::kIo);
      ++half;
    }
  }
  EXPECT_GT(half, 0);
}

TEST(StreamSource, ShowsANewSizeAsItIs) {
  std::atomic<bool> turned{false};
  test::MjpegServer server(
      [&](int number) -> cv::Mat {
        const cv::Mat upright = numbered(number);
        return turned ? cv::Mat(upright.t()) : upright;
      },
      50.0);
  StreamingCamera camera(openStreamSource(server.url(), brief()).value(), patient());
  ASSERT_TRUE(camera.grabAfter(steadySeconds(), {}));
  turned = true;
  std::this_thread::sleep_for(200ms);
  const auto frame = camera.grabAfter(steadySeconds() + 0.2, {});
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_EQ((*frame)->image_bgr.size(), cv::Size(96, 64));
}

TEST(StreamSource, SaysThatNothingListensAndHidesThePassword) {
  const auto source = openStreamSource("http://me:secret@127.0.0.1:9/video", brief());
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, Error::Code::kNotFound);
  EXPECT_EQ(source.error().sentence().find("secret"), std::string::npos);
  EXPECT_THAT(source.error().what, HasSubstr("http://me:***@127.0.0.1:9/video"));
}

TEST(StreamSource, AsksForAPasswordThatWasNotStored) {
  const auto source = openStreamSource("http://me:***@127.0.0.1:9/video", brief());
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, Error::Code::kNoPermission);
  EXPECT_THAT(source.error().advice, HasSubstr("--camera"));
}

}  // namespace
}  // namespace gyre
