// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/angle_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

using testing::HasSubstr;

struct Motor {
  std::vector<std::optional<double>> commanded;
  std::vector<double> angles;

  Motor(int count, double white_rad) {
    Random random(5);
    for (int k = 0; k < count; ++k) {
      commanded.push_back(kTurn_rad * k / count);
      angles.push_back(*commanded.back() + white_rad * random.gaussian());
    }
  }
};

TEST(AnglePattern, SaysNothingOfAPerfectMotor) {
  const Motor motor(48, 0.0);
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  EXPECT_NEAR(pattern.step_scale.value(), 1.0, 1e-9);
  EXPECT_TRUE(pattern.jumps.empty());
  EXPECT_TRUE(pattern.ripples.empty());
}

TEST(AnglePattern, SaysNothingOfWhiteNoise) {
  const Motor motor(160, radFromDeg(0.05));
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  EXPECT_TRUE(pattern.jumps.empty());
  EXPECT_TRUE(pattern.ripples.empty());
  EXPECT_NEAR(degFromRad(pattern.white_rad), 0.05, 0.01);
}

TEST(AnglePattern, FindsWhatComesBackWithEachTurn) {
  Motor motor(48, radFromDeg(0.02));
  for (double& a : motor.angles) {
    a = 1.01 * a + radFromDeg(0.3) * std::sin(a + 0.7) + radFromDeg(0.1) * std::sin(2 * a - 1.0);
  }
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  EXPECT_NEAR(pattern.step_scale.value(), 1.01, 1e-3);
  // 0.02 deg over the root of half of 48 pictures, times 3 and what the scale takes of a sine.
  EXPECT_NEAR(degFromRad(pattern.once_per_turn.amplitude_rad), 0.3, 0.03);
  EXPECT_NEAR(pattern.once_per_turn.phase_rad, 0.7, 0.1);
  EXPECT_NEAR(degFromRad(pattern.twice_per_turn.amplitude_rad), 0.1, 0.03);
  EXPECT_TRUE(pattern.jumps.empty());
}

TEST(AnglePattern, FindsRippleAndItsPeriod) {
  Motor motor(160, radFromDeg(0.02));
  for (double& a : motor.angles) a += radFromDeg(0.2) * std::sin(40.0 * a);
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  ASSERT_FALSE(pattern.ripples.empty());
  EXPECT_NEAR(degFromRad(pattern.ripples[0].period_rad), 9.0, 0.1);
  EXPECT_NEAR(degFromRad(pattern.ripples[0].amplitude_rad), 0.2, 0.03);
}

TEST(AnglePattern, FindsAStopAndSaysWhere) {
  Motor motor(48, radFromDeg(0.02));
  for (std::size_t k = 20; k < 48; ++k) motor.angles[k] -= radFromDeg(2.0);
  std::vector<std::string> names;
  for (int k = 0; k < 48; ++k) names.push_back("p" + std::to_string(k));
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  ASSERT_EQ(pattern.jumps.size(), 1U);
  EXPECT_EQ(pattern.jumps[0].first, 19U);
  EXPECT_NEAR(pattern.step_scale.value(), 1.0, 1e-3);  // the jump does not bend the scale
  const auto sentences = sentencesOf(pattern, names);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_THAT(sentences[0], HasSubstr("p19 and p20"));
  EXPECT_THAT(sentences[0], HasSubstr("7.50 deg"));
}

TEST(AnglePattern, TakesEvenStepsForCommands) {
  Motor motor(48, radFromDeg(0.02));
  motor.commanded.assign(48, std::nullopt);
  motor.angles[30] += radFromDeg(3.0);
  const AnglePattern pattern = anglePatternOf(motor.angles, motor.commanded);
  EXPECT_FALSE(pattern.step_scale);
  ASSERT_EQ(pattern.jumps.size(), 1U);
  EXPECT_EQ(pattern.jumps[0].moved_rad.size(), 2U);  // there and back
}

TEST(AnglePattern, BearsHardlyAnyPictures) {
  EXPECT_FALSE(anglePatternOf({}, {}).step_scale);
  EXPECT_FALSE(anglePatternOf({0.0}, {0.0}).step_scale);
  EXPECT_NEAR(anglePatternOf({0.0, 1.0}, {0.0, 1.0}).step_scale.value(), 1.0, 1e-9);
}

}  // namespace
}  // namespace gyre
