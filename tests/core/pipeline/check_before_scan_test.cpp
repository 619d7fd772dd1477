// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/check_before_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

using testing::HasSubstr;

// A desk with texture.
cv::Mat desk(int moved_px) {
  cv::Mat noise(300, 400, CV_8UC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, {}, 3.0);
  cv::normalize(smooth, smooth, 20, 235, cv::NORM_MINMAX);
  cv::Mat picture;
  cv::cvtColor(smooth(cv::Rect(20 - moved_px, 10, 360, 280)), picture, cv::COLOR_GRAY2BGR);
  return picture;
}

TEST(CheckByBackground, TellsWhetherTheCameraMoved) {
  const BeforeScanCheck still = checkByBackground(desk(0), desk(0));
  EXPECT_TRUE(still.judged && still.holds);
  const BeforeScanCheck moved = checkByBackground(desk(0), desk(3));
  EXPECT_TRUE(moved.judged);
  EXPECT_FALSE(moved.holds);
  EXPECT_NEAR(moved.px, 3.0, 0.1);
  EXPECT_THAT(moved.sentence, HasSubstr("3.0 px off"));
  const BeforeScanCheck other = checkByBackground(desk(0), cv::Mat::zeros(280, 360, CV_8UC3));
  EXPECT_FALSE(other.judged);
}

CalibrationRecord recordAt(int width_px, double focus) {
  CalibrationRecord record;
  record.calibration.camera.width_px = width_px;
  record.calibration.camera.height_px = 480;
  record.camera = CalibratedCamera{"cam", "", {{"focus", focus}}};
  return record;
}

TEST(SameCameraAsCalibrated, RefusesAnotherModeOrFocus) {
  CameraInfo camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.controls.push_back({"focus", true, 30.0, ""});
  EXPECT_TRUE(sameCameraAsCalibrated(recordAt(640, 30.0), camera));
  const auto mode = sameCameraAsCalibrated(recordAt(1280, 30.0), camera);
  ASSERT_FALSE(mode);
  EXPECT_THAT(mode.error().what, HasSubstr("640x480"));
  const auto focus = sameCameraAsCalibrated(recordAt(640, 45.0), camera);
  ASSERT_FALSE(focus);
  EXPECT_THAT(focus.error().what, HasSubstr("focus"));
  CalibrationRecord foreign = recordAt(640, 0.0);
  foreign.camera.reset();  // as other programs write it
  EXPECT_TRUE(sameCameraAsCalibrated(foreign, camera));
}

TEST(CalibratedCamera, KeepsWhatIsLocked) {
  CameraInfo camera;
  camera.description = "A camera";
  camera.width_px = 640;
  camera.height_px = 480;
  camera.controls = {{"focus", true, 30.0, ""}, {"gain", false, 2.0, "It cannot."}};
  const CalibratedCamera kept = calibratedCamera(camera);
  EXPECT_EQ(kept.mode, "640x480");
  EXPECT_EQ(kept.settings.size(), 1U);
}

}  // namespace
}  // namespace gyre
