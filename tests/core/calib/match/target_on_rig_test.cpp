// Finds the standard targets on the simulated rig through a full turn.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/calib/match/find_target.h"
#include "core/calib/targets/standard_targets.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

struct RigTrial {
  const char* target;
  int width_px;
  double noise;
  double blur_px;
};

class TargetOnRig : public testing::TestWithParam<RigTrial> {};
INSTANTIATE_TEST_SUITE_P(
    Turns, TargetOnRig,
    testing::Values(RigTrial{"wedge", 1280, 2.0, 0.8}, RigTrial{"coded-cube", 1280, 2.0, 0.8},
                    RigTrial{"cube", 1280, 2.0, 0.8}, RigTrial{"wedge", 640, 2.0, 0.8},
                    RigTrial{"coded-cube", 640, 2.0, 0.8}, RigTrial{"cube", 640, 2.0, 0.8},
                    RigTrial{"wedge", 1280, 5.0, 1.5}, RigTrial{"cube", 1280, 5.0, 1.5}),
    [](const auto& trial) {
      std::string name = trial.param.target;
      std::erase(name, '-');
      return name + std::to_string(trial.param.width_px) + "Noise" +
             std::to_string(static_cast<int>(trial.param.noise));
    });

TEST_P(TargetOnRig, IsFoundAndNamedRightAtEachOf24Angles) {
  RigSettings rig;
  rig.object = "target";
  rig = atImageWidth(rig, GetParam().width_px);
  rig.noise_sigma = GetParam().noise;
  rig.blur_sigma_px = GetParam().blur_px;
  const Target target = standardTarget(GetParam().target)->target;
  const Renderer renderer(rig, PrintedTarget::make(target, rig).value());
  const Calibration truth = trueCalibration(rig);
  const auto points = pointsOf(target);
  double squares = 0.0;
  double in_sigmas = 0.0;
  double count = 0.0;
  std::size_t least = 10000;
  for (int k = 0; k < 24; ++k) {
    const std::int64_t steps = rig.steps_per_turn * k / 24;
    const auto found = findTarget(renderer.render(steps, TableLoad::kObject).image_bgr, target);
    ASSERT_TRUE(found) << k << ": " << found.error().sentence();
    EXPECT_EQ(found->labellings, 1) << k;
    least = std::min(least, found->view.sightings.size());
    const Rigid3 cam_from_target =
        camFromTable(*truth.cam_from_table, trueAngleRad(rig, steps)) * tableFromTarget(rig);
    for (const PointSighting& sighting : found->view.sightings) {
      const auto& position = points[static_cast<std::size_t>(sighting.point)].position_in_target;
      const Eigen::Vector2d miss =
          sighting.pixel - *truth.camera.project(cam_from_target * position);
      EXPECT_LT(miss.norm(), 1.0) << k << " point " << sighting.point;
      squares += 0.5 * miss.squaredNorm();
      in_sigmas += 0.5 * miss.squaredNorm() / (sighting.sigma_px * sighting.sigma_px);
      count += 1.0;
    }
  }
  const double rms_px = std::sqrt(squares / count);
  const double rms_sigma = std::sqrt(in_sigmas / count);
  RecordProperty("rms_px", std::to_string(rms_px));
  RecordProperty("rms_sigma", std::to_string(rms_sigma));
  RecordProperty("least_points", static_cast<int>(least));
  RecordProperty("mean_points", std::to_string(count / 24.0));
  // The wedge's back, of 24 corners, is the least that looks at the camera.
  EXPECT_GE(least, 20u);
  // The corner detector's goals at noise 2 and 5.
  EXPECT_LT(rms_px, GetParam().noise > 2.0 ? 0.05 : 0.035);
  EXPECT_LT(rms_sigma, 1.4);
}

}  // namespace
}  // namespace gyre
