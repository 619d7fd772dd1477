// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/target_pose.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/sim/rig.h"

namespace gyre {
namespace {

std::vector<KnownPoint> seen(const Calibration& truth, double height_mm, double noise_px) {
  Random random(4);
  std::vector<KnownPoint> points;
  for (int i = 0; i < 25; ++i) {
    const Eigen::Vector3d x(10.0 * (i % 5) - 20.0, 10.0 * (i / 5) - 20.0,
                            height_mm * random.uniform());
    const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
    points.push_back({x, *truth.camera.project(*truth.cam_from_table * x) + noise_px * noise});
  }
  return points;
}

TEST(TargetPose, IsExactForSolidAndFlatTargets) {
  const Calibration truth = trueCalibration(RigSettings{});
  for (const double height_mm : {0.0, 30.0}) {
    const auto pose = targetPose(truth.camera, seen(truth, height_mm, 0.0));
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->cam_from_target.translation - truth.cam_from_table->translation).norm(), 1e-4);
    EXPECT_LT(pose->median_px, 1e-5);
  }
}

TEST(TargetPose, BearsWrongPoints) {
  const Calibration truth = trueCalibration(RigSettings{});
  std::vector<KnownPoint> points = seen(truth, 30.0, 0.05);
  points[3].pixel.x() += 60.0;
  points[12].pixel.y() -= 90.0;
  const auto pose = targetPose(truth.camera, points);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->cam_from_target.translation - truth.cam_from_table->translation).norm(), 1.0);
}

TEST(TargetPose, RefusesTooFewPoints) {
  const Calibration truth = trueCalibration(RigSettings{});
  std::vector<KnownPoint> points = seen(truth, 30.0, 0.0);
  points.resize(3);
  EXPECT_FALSE(targetPose(truth.camera, points));
  EXPECT_FALSE(targetPose(truth.camera, {}));
}

}  // namespace
}  // namespace gyre
