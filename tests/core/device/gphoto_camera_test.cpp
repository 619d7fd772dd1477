// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_camera.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/base/clock.h"
#include "tests/support/ptpip_camera.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using namespace std::chrono_literals;
using test::Bytes;
using test::PtpIpCamera;
using testing::HasSubstr;

constexpr int kGreyStep = 20;

Bytes numbered(int number) {
  Bytes bytes;
  cv::imencode(".jpg", cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(kGreyStep * (number + 1))),
               bytes);
  return bytes;
}

int numberOf(const FramePtr& frame) {
  return (frame->image_bgr.at<cv::Vec3b>(20, 20)[0] + kGreyStep / 2) / kGreyStep - 1;
}

ControlState named(const CameraInfo& info, const std::string& name) {
  const auto found = std::find_if(info.controls.begin(), info.controls.end(),
                                  [&](const ControlState& state) { return state.name == name; });
  return found == info.controls.end() ? ControlState{"missing", false, -1.0, ""} : *found;
}

// libgphoto2 keeps its settings in the user's home.
class GphotoCamera : public testing::Test {
 protected:
  GphotoCamera() { setenv("HOME", home_.path().c_str(), 1); }

  const TempDir home_;
};

TEST_F(GphotoCamera, TakesOneFullPictureForEachMoment) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  EXPECT_EQ(device.shots(), 0) << "opening takes no picture";
  for (int i = 0; i < 3; ++i) {
    const double asked_s = steadySeconds();
    const auto frame = (*camera)->grabAfter(asked_s, {});
    ASSERT_TRUE(frame) << frame.error().sentence();
    EXPECT_EQ((*frame)->image_bgr.size(), cv::Size(160, 120));
    EXPECT_EQ(numberOf(*frame), i);
    EXPECT_GT((*frame)->time_s, asked_s);
    EXPECT_EQ((*camera)->grabAfter(asked_s, {}).value(), *frame) << "a second look costs no shot";
  }
  EXPECT_EQ(device.shots(), 3);
  EXPECT_EQ(device.filesLeft(), 0);
  EXPECT_EQ((*camera)->info().width_px, 160);
}

TEST_F(GphotoCamera, WaitsForTheMoment) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  const double moment_s = steadySeconds() + 0.3;
  const auto frame = (*camera)->grabAfter(moment_s, {});
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_GE((*frame)->time_s, moment_s);
}

TEST_F(GphotoCamera, ReadsBackWhatStandsOnTheCameraAndLocksTheFocus) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  EXPECT_FALSE(named((*camera)->info(), "focus").locked);
  const auto locked = (*camera)->lockControls();
  ASSERT_TRUE(locked) << locked.error().sentence();
  EXPECT_TRUE(named(*locked, "focus").locked) << named(*locked, "focus").word;
  EXPECT_EQ(device.property(PtpIpCamera::kFocusMode), 1);
  EXPECT_EQ(named(*locked, "aperture").value, 8.0) << named(*locked, "aperture").word;
  EXPECT_TRUE(named(*locked, "aperture").locked);
  EXPECT_TRUE(named(*locked, "white balance").locked) << named(*locked, "white balance").word;
  EXPECT_FALSE(named(*locked, "gain").locked);
  EXPECT_THAT(named(*locked, "gain").remark, HasSubstr("does not tell"));
}

TEST_F(GphotoCamera, SeesThatSomebodyTurnedADial) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  device.setProperty(PtpIpCamera::kFNumber, 1100);
  device.setProperty(PtpIpCamera::kWhiteBalance, 2);
  std::this_thread::sleep_for(2200ms);  // libgphoto2 remembers a property for two seconds
  const auto now = (*camera)->readControls();
  ASSERT_TRUE(now);
  EXPECT_EQ(named(*now, "aperture").value, 11.0) << named(*now, "aperture").word;
  EXPECT_FALSE(named(*now, "white balance").locked) << named(*now, "white balance").word;
  EXPECT_THAT(named(*now, "white balance").remark, HasSubstr("white balance"));
}

TEST_F(GphotoCamera, HasNoLivePictureWhereTheCameraHasNone) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  const auto live = (*camera)->preview({});
  ASSERT_FALSE(live);
  EXPECT_EQ(live.error().code, Error::Code::kRejected);
  EXPECT_EQ(device.shots(), 0);
}

// libgphoto2 goes on waiting for the picture of a camera that refused to take one.
TEST_F(GphotoCamera, GivesUpOnACameraThatRefusesAndGoesOnAfterwards) {
  PtpIpCamera device(numbered);
  GphotoOptions options;
  options.shot_timeout_s = 1.5;
  auto camera = openGphotoCamera(device.word(), options);
  ASSERT_TRUE(camera) << camera.error().sentence();
  device.refuseShots(true);
  Result<FramePtr> frame = (*camera)->grabAfter(steadySeconds(), {});
  ASSERT_FALSE(frame);
  EXPECT_FALSE(frame.error().advice.empty());
  device.refuseShots(false);
  device.vanish();  // switched off and on
  std::this_thread::sleep_for(100ms);
  device.comeBack();
  for (int i = 0; i < 4 && !frame; ++i) frame = (*camera)->grabAfter(steadySeconds(), {});
  EXPECT_TRUE(frame) << frame.error().sentence();
}

TEST_F(GphotoCamera, IsOpenedAnewWhenItWasLost) {
  PtpIpCamera device(numbered);
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  device.vanish();
  Result<FramePtr> frame = (*camera)->grabAfter(steadySeconds(), {});
  ASSERT_FALSE(frame);
  EXPECT_FALSE(frame.error().advice.empty());
  device.comeBack();
  for (int i = 0; i < 3 && !frame; ++i) frame = (*camera)->grabAfter(steadySeconds(), {});
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_EQ(numberOf(*frame), device.shots() - 1);
}

TEST_F(GphotoCamera, GivesUpOnAFrozenCameraInTimeAndOnRequest) {
  PtpIpCamera device(numbered);
  GphotoOptions options;
  options.shot_timeout_s = 0.5;
  auto camera = openGphotoCamera(device.word(), options);
  ASSERT_TRUE(camera) << camera.error().sentence();
  device.freeze(true);
  const double start_s = steadySeconds();
  EXPECT_EQ((*camera)->grabAfter(steadySeconds(), {}).error().code, Error::Code::kTimeout);
  EXPECT_LT(steadySeconds() - start_s, 2.0);
  std::stop_source stop;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(50ms);
    stop.request_stop();
  });
  EXPECT_EQ((*camera)->grabAfter(steadySeconds(), Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
  device.freeze(false);
}

TEST_F(GphotoCamera, RefusesHalfAPictureAndWhatIsNone) {
  PtpIpCamera device([](int shot) {
    Bytes bytes = numbered(shot);
    bytes.resize(shot == 0 ? bytes.size() / 2 : 3);
    return bytes;
  });
  auto camera = openGphotoCamera(device.word());
  ASSERT_TRUE(camera) << camera.error().sentence();
  for (int i = 0; i < 2; ++i) {
    const auto frame = (*camera)->grabAfter(steadySeconds(), {});
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, Error::Code::kIo) << frame.error().sentence();
  }
}

TEST_F(GphotoCamera, SaysThatNoCameraIsThere) {
  const auto nobody = openGphotoCamera("ptpip:127.0.0.1:9");
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().code, Error::Code::kNotFound) << nobody.error().sentence();
  const auto none = openGphotoCamera("gphoto:");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Error::Code::kNotFound) << none.error().sentence();
  EXPECT_EQ(openGphotoCamera("ptpip:").error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
