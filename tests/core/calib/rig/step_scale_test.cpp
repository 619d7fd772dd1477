// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/step_scale.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/rig/axis_from_poses.h"

namespace gyre {
namespace {

using Angles = std::vector<std::optional<double>>;

Angles evenly(int count, double step_rad) {
  Angles angles;
  for (int k = 0; k < count; ++k) angles.push_back(step_rad * k);
  return angles;
}

Angles seenAt(const Angles& commanded, double scale, double noise_rad) {
  Random random(3);
  Angles seen;
  for (const auto& angle : commanded) {
    seen.push_back(wrapped(scale * *angle + noise_rad * random.gaussian()));
  }
  return seen;
}

TEST(StepScale, IsFoundForwardsAndBackwardsFromAFiftiethToFifty) {
  // Commands that are not evenly spaced leave no other explanation.
  Angles commanded;
  for (const double deg : {0.0, 0.1, 0.25, 0.6, 1.3, 2.7, 5.1, 11.0, 23.0, 47.0, 101.0, 200.0}) {
    commanded.push_back(radFromDeg(deg));
  }
  for (const double scale : {1.0, -1.0, 2.0, -0.5, 1.0 / 50.0, -1.0 / 50.0, 49.9, -49.9, 1.4142}) {
    const auto found = stepScaleFrom(commanded, seenAt(commanded, scale, 1e-4));
    ASSERT_TRUE(found);
    // A ten-thousandth of a radian over 200 deg.
    EXPECT_NEAR(*found, scale, 2e-4) << scale;
  }
}

TEST(StepScale, TakesTheLikeliestOfWhatEvenStepsCannotTell) {
  const Angles commanded = evenly(24, radFromDeg(15.0));
  for (const double scale : {1.0, -1.0, 2.0, 0.02}) {
    EXPECT_NEAR(stepScaleFrom(commanded, seenAt(commanded, scale, 1e-3)).value(), scale, 1e-3);
  }
  // Three stops a turn, twice round: -0.5 would do as well and move less.
  const Angles wide = evenly(7, radFromDeg(240.0));
  EXPECT_NEAR(stepScaleFrom(wide, seenAt(wide, 1.0, 1e-4)).value(), 1.0, 1e-3);
}

TEST(StepScale, BearsWrongAngles) {
  const Angles commanded = evenly(24, radFromDeg(15.0));
  Angles seen = seenAt(commanded, 1.01, 1e-3);
  seen[3] = 2.0;
  seen[11] = -1.0;
  seen[17].reset();
  EXPECT_NEAR(stepScaleFrom(commanded, seen).value(), 1.01, 0.005);
}

TEST(StepScale, NeedsTwoCommands) {
  EXPECT_FALSE(stepScaleFrom({}, {}));
  EXPECT_FALSE(stepScaleFrom({0.0}, {0.0}));
  EXPECT_FALSE(stepScaleFrom({0.5, 0.5}, {0.0, 0.1}));
  EXPECT_FALSE(stepScaleFrom({0.0, std::nullopt}, {0.0, 0.1}));
}

TEST(UnwrappedAngles, FollowCommandsOrNeighbours) {
  const Angles commanded = evenly(5, radFromDeg(100.0));
  const std::vector<double> told = unwrappedAngles(commanded, seenAt(commanded, 1.0, 0.0), 1.0);
  EXPECT_NEAR(told[4], radFromDeg(400.0), 1e-12);
  const std::vector<double> alone = unwrappedAngles(Angles(5), seenAt(commanded, 1.0, 0.0), 1.0);
  EXPECT_NEAR(alone[4], radFromDeg(400.0), 1e-12);
}

}  // namespace
}  // namespace gyre
