// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/solved_turning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TurnedView told(int view, double angle_deg) {
  TurnedView turned;
  turned.view = view;
  turned.told_rad = turned.angle_rad = radFromDeg(angle_deg);
  return turned;
}

TEST(BeliefsBeforeSolving, TrustTheFirstViewTheRingAndThenTheMotor) {
  std::vector<TurnedView> views = {told(0, 0.0), told(1, 5.0), told(2, 10.0)};
  views[2].seen = true;
  views[2].sigma_rad = 1e-5;
  RecoverOptions options;
  options.angle_sigma_deg = 0.03;
  options.angle_freedom_deg = 0.5;
  const AngleBeliefs beliefs = beliefsBeforeSolving(views, options);
  EXPECT_EQ(beliefs.prior_sigma_rad, (std::vector<double>{0.0, radFromDeg(0.5), 1e-5}));
  EXPECT_EQ(beliefs.expected_sigma_rad, (std::vector<double>{0.0, radFromDeg(0.03), 1e-5}));
  EXPECT_TRUE(beliefsBeforeSolving({}, options).prior_sigma_rad.empty());
}

TEST(AfterSolving, TellsHowFarTheMotorWasOff) {
  TurningReport before;
  before.views = {told(0, 0.0), told(1, 5.0), told(2, 10.0)};
  TurnEstimate solved;
  solved.corrections_rad = {0.0, radFromDeg(0.3), radFromDeg(-0.4)};
  solved.sigma_rad = {0.0, radFromDeg(0.002), radFromDeg(0.2)};
  const TurningReport after = afterSolving(before, solved);
  EXPECT_NEAR(after.views[2].angle_rad, radFromDeg(9.6), 1e-12);
  EXPECT_NEAR(after.worst_off_rad, radFromDeg(0.4), 1e-12);
  EXPECT_NEAR(after.rms_off_rad, radFromDeg(0.5) / std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(after.views[1].seen);
  EXPECT_FALSE(after.views[2].seen) << "0.2 deg is no better than the motor";
  EXPECT_FALSE(after.lostSteps());
  EXPECT_THAT(after.sentence, HasSubstr("within 0.400"));
}

TEST(AfterSolving, KeepsWhatTheRingSaid) {
  TurningReport before;
  before.views = {told(0, 0.0)};
  before.sentence = "The markers told.";
  EXPECT_EQ(afterSolving(before, {{}, {0.0}, {0.0}}).sentence, "The markers told.");
}

TEST(AfterSolving, OfNoViewsIsNothing) { EXPECT_TRUE(afterSolving({}, {}).views.empty()); }

}  // namespace
}  // namespace gyre
