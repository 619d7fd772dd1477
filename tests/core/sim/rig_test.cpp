// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/rig.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace gyre {
namespace {

TEST(Rig, DefaultsAreTheDefaultRig) {
  const RigSettings rig;
  EXPECT_TRUE(rig.validate().ok());
  const Calibration truth = trueCalibration(rig);
  EXPECT_EQ(truth.camera.width_px, 1280);
  EXPECT_EQ(truth.camera.height_px, 960);
  EXPECT_DOUBLE_EQ(truth.camera.fx, 2400.0);
  EXPECT_DOUBLE_EQ(truth.camera.k1, -0.08);
  EXPECT_NEAR(std::hypot(truth.camera.cx - 639.5, truth.camera.cy - 479.5), 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(rig.object_size_mm, 80.0);
  EXPECT_NEAR(objectOffsetInTable(rig).norm(), 5.0, 1e-12);
}

TEST(Rig, CameraLooksAtTheAxisFromAboveWithTheTablesXTowardsIt) {
  const RigSettings rig;
  const Rigid3 cam_from_table = *trueCalibration(rig).cam_from_table;
  EXPECT_TRUE(isRigid(cam_from_table, 1e-12));
  const Eigen::Vector3d camera_in_table = cam_from_table.inverse().translation;
  EXPECT_NEAR(camera_in_table.y(), 0.0, 1e-9);
  EXPECT_GT(camera_in_table.x(), 0.0);
  const Eigen::Vector3d aim_in_cam = cam_from_table * Eigen::Vector3d(0.0, 0.0, rig.aim_height_mm);
  EXPECT_NEAR((aim_in_cam - Eigen::Vector3d(0.0, 0.0, 350.0)).norm(), 0.0, 1e-9);
  // The optical axis falls 30 degrees; the table's up is up in the picture, but for the roll.
  EXPECT_NEAR(cam_from_table.rotation.row(2).z(), -std::sin(radFromDeg(30.0)), 1e-12);
  const Eigen::Vector3d up_in_cam = cam_from_table.rotation.col(2);
  EXPECT_LT(up_in_cam.y(), 0.0);
  EXPECT_NEAR(std::abs(std::atan2(up_in_cam.x(), -up_in_cam.y())), radFromDeg(1.0), 1e-9);
}

TEST(Rig, KeyLightStandsFortyDegreesOffTheCamera) {
  const RigSettings rig;
  const Eigen::Vector3d to_camera =
      -trueCalibration(rig).cam_from_table->rotation.row(2).transpose();
  EXPECT_NEAR(std::acos(keyLightInBase(rig).dot(to_camera)), radFromDeg(40.0), 1e-9);
  EXPECT_GT(keyLightInBase(rig).z(), to_camera.z());
}

TEST(Rig, MotorErrorsHaveTheirSizes) {
  RigSettings rig;
  rig.once_per_turn_error_deg = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < rig.steps_per_turn; ++i) {
    const double error_deg = degFromRad(trueAngleRad(rig, i) - kTurn_rad * i / rig.steps_per_turn);
    sum += error_deg;
    squares += error_deg * error_deg;
  }
  const double n = rig.steps_per_turn;
  const double sigma_deg = std::sqrt(squares / n - (sum / n) * (sum / n));
  EXPECT_NEAR(sigma_deg, 0.02, 0.001);  // 3200 draws: 4 standard errors

  rig.white_error_deg = 0.0;
  rig.once_per_turn_error_deg = 0.05;
  double least = 1e9;
  double most = -1e9;
  for (int i = 0; i < rig.steps_per_turn; ++i) {
    const double error_deg = degFromRad(trueAngleRad(rig, i) - kTurn_rad * i / rig.steps_per_turn);
    least = std::min(least, error_deg);
    most = std::max(most, error_deg);
  }
  EXPECT_NEAR(most - least, 0.1, 1e-4);
}

TEST(Rig, AnglesAreAPureFunctionOfSeedAndStepsAndZeroAtZero) {
  RigSettings rig;
  EXPECT_EQ(trueAngleRad(rig, 0), 0.0);
  EXPECT_EQ(trueAngleRad(rig, 777), trueAngleRad(rig, 777));
  RigSettings other = rig;
  other.seed = 2;
  EXPECT_NE(trueAngleRad(rig, 777), trueAngleRad(other, 777));
  rig.white_error_deg = rig.once_per_turn_error_deg = 0.0;
  rig.step_scale_error = 0.01;
  EXPECT_NEAR(trueAngleRad(rig, -1600), -1.01 * kPi, 1e-12);
}

TEST(Rig, SmallerPicturesShowTheSameScene) {
  const RigSettings rig = atImageWidth({}, 640);
  EXPECT_EQ(rig.image_height_px, 480);
  EXPECT_DOUBLE_EQ(rig.focal_px, 1200.0);
  EXPECT_DOUBLE_EQ(rig.texture_finest_mm, 1.5);
}

TEST(Rig, RefusesWhatItDoesNotHave) {
  RigSettings rig;
  rig.object = "teapot";
  EXPECT_NE(rig.validate().error().advice.find("duck"), std::string::npos);
  rig = {};
  rig.material = "furry";
  EXPECT_FALSE(rig.validate().ok());
  rig = {};
  rig.focal_px = std::nan("");
  EXPECT_FALSE(rig.validate().ok());
}

}  // namespace
}  // namespace gyre
