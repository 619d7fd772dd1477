// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/stage.h"

#include <gtest/gtest.h>

#include "core/geometry/ray.h"

namespace gyre {
namespace {

TEST(Stage, RaysAreTheCamerasOwn) {
  RigSettings rig = atImageWidth({}, 160);
  rig.k1 = -0.3;
  const Stage stage(rig, trueCalibration(rig));
  const Calibration truth = trueCalibration(rig);
  for (const auto& [x, y] : {std::pair{0, 0}, {159, 119}, {80, 60}, {20, 100}}) {
    const std::size_t pixel = static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x);
    const Eigen::Vector3d in_cam =
        truth.cam_from_table->rotation * stage.direction(pixel).cast<double>();
    EXPECT_NEAR(in_cam.z(), 1.0, 1e-6);
    const Eigen::Vector2d uv = *truth.camera.project(in_cam);
    EXPECT_NEAR((uv - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-3);  // single precision
  }
}

TEST(Stage, PlatterCoversTheDiscOfItsRadius) {
  const RigSettings rig = atImageWidth({}, 160);
  const Stage stage(rig, trueCalibration(rig));
  double covered = 0.0;
  int expected = 0;
  for (std::size_t i = 0; i < 160 * 120; ++i) {
    covered += static_cast<double>(stage.platterCoverage(i));
    const auto at = meetHorizontalPlane(
        {stage.cameraInBase(), stage.direction(i).cast<double>().normalized()}, 0.0);
    expected += at && at->head<2>().norm() <= rig.platter_radius_mm ? 1 : 0;
  }
  EXPECT_GT(expected, 3000);
  EXPECT_NEAR(covered, expected, 0.01 * expected);
}

TEST(Stage, CameraBelowSeesNoPlatterTop) {
  RigSettings rig = atImageWidth({}, 160);
  rig.camera_elevation_deg = -40.0;
  const Stage stage(rig, trueCalibration(rig));
  for (std::size_t i = 0; i < 160 * 120; ++i) ASSERT_EQ(stage.platterCoverage(i), 0.0F);
}

TEST(Stage, BrightnessActsOnTheBackgroundOnly) {
  const RigSettings rig = atImageWidth({}, 160);
  const Stage stage(rig, trueCalibration(rig));
  LightImage normal(160, 120);
  LightImage bright(160, 120);
  for (int y = 0; y < 120; ++y) {
    stage.paintRow(y, 0.3, 1.0F, normal);
    stage.paintRow(y, 0.3, 1.5F, bright);
  }
  for (std::size_t i = 0; i < 160 * 120; ++i) {
    if (stage.platterCoverage(i) == 1.0F) {
      ASSERT_EQ(normal.bgr[3 * i], bright.bgr[3 * i]);
    }
    if (stage.platterCoverage(i) == 0.0F) {
      ASSERT_NEAR(1.5F * normal.bgr[3 * i], bright.bgr[3 * i], 1e-6F);
    }
  }
}

}  // namespace
}  // namespace gyre
