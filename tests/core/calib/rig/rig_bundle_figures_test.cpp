// The judged figures of the rig bundle: ten seeds of ideal sightings on the default rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/calib/rig/rig_bundle.h"
#include "core/calib/targets/standard_targets.h"
#include "core/sim/rig.h"
#include "tests/support/calibration_figures.h"
#include "tests/support/turned_target.h"

namespace gyre {
namespace {

constexpr int kSeeds = 10;

// The ones people print.
std::vector<Target> printedTargets() {
  return {standardTarget("wedge").value().target, standardTarget("coded-cube").value().target};
}

void addSeed(const test::TurnedTarget& turned, int seed,
             std::vector<test::CalibrationMiss>& misses) {
  RigBundleOptions options;
  options.image_width_px = 1280;
  options.image_height_px = 960;
  const auto found =
      calibrateRig(turned.views(static_cast<std::uint64_t>(seed)), turned.target, options, Task{});
  ASSERT_TRUE(found) << found.error().sentence();
  misses.push_back(test::missOf(*found, turned.truth, turned.true_rad));
}

TEST(RigBundleFigures, HoldOnWedgeAndCube) {
  for (const Target& target : printedTargets()) {
    std::vector<test::CalibrationMiss> misses;
    for (int seed = 1; seed <= kSeeds; ++seed) addSeed(test::TurnedTarget(target), seed, misses);
    test::judgeFigures(target.name, misses);
  }
}

TEST(RigBundleFigures, HoldWithAPoorMotor) {
  for (const Target& target : printedTargets()) {
    std::vector<test::CalibrationMiss> misses;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      test::TurnedTarget turned(target);
      RigSettings rig;
      rig.seed = seed;
      rig.step_scale_error = 0.01;
      rig.once_per_turn_error_deg = 0.3;
      rig.white_error_deg = 0.05;
      for (std::size_t k = 0; k < turned.true_rad.size(); ++k) {
        turned.true_rad[k] = trueAngleRad(
            rig, std::lround(turned.commanded_rad[k] / kTurn_rad * rig.steps_per_turn));
      }
      addSeed(turned, seed, misses);
    }
    test::judgeFigures(target.name + ", poor motor", misses);
  }
}

}  // namespace
}  // namespace gyre
