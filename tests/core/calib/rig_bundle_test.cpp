// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig_bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "tests/support/turned_target.h"

namespace gyre {
namespace {

using test::TurnedTarget;
using testing::HasSubstr;

RigBundleOptions defaultOptions() {
  RigBundleOptions options;
  options.image_width_px = 1280;
  options.image_height_px = 960;
  return options;
}

// Between the axes as the camera sees them.
double tiltRad(const Calibration& a, const Calibration& b) {
  const Eigen::Vector3d za = a.cam_from_table->rotation.col(2);
  const Eigen::Vector3d zb = b.cam_from_table->rotation.col(2);
  return std::atan2(za.cross(zb).norm(), za.dot(zb));
}

double anglesRms(const std::vector<double>& found, const std::vector<double>& truth) {
  double sum = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) sum += std::pow(found[k] - truth[k], 2);
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

TEST(CalibrateRig, FindsAnExactRigExactly) {
  TurnedTarget turned(test::wedgeTarget());
  turned.noise_px = 0.0;
  const auto found = calibrateRig(turned.views(1), turned.target, defaultOptions(), Task{});
  ASSERT_TRUE(found) << found.error().sentence();
  const CameraModel& camera = found->calibration.camera;
  EXPECT_NEAR(camera.fx, 2400.0, 0.01);
  EXPECT_NEAR(camera.fy, 2400.0, 0.01);
  EXPECT_NEAR(camera.cx, turned.truth.camera.cx, 0.01);
  EXPECT_NEAR(camera.cy, turned.truth.camera.cy, 0.01);
  EXPECT_NEAR(camera.k1, -0.08, 1e-4);
  EXPECT_LT(tiltRad(found->calibration, turned.truth), 1e-5);
  EXPECT_LT(
      (found->calibration.cam_from_table->translation - turned.truth.cam_from_table->translation)
          .norm(),
      0.01);
  EXPECT_LT(anglesRms(found->report.angles_rad, turned.true_rad), 1e-6);
  EXPECT_LT(found->report.rms_px, 1e-4);
}

}  // namespace
}  // namespace gyre
