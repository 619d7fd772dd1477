// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/stepper_motion.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

// 1000 steps at 200/s with 400/s^2: rise 0.5 s over 50 steps, cruise 4.5 s, fall 0.5 s.
constexpr MotionBlock kLong{1000, 200.0, 400.0};

TEST(StepperMotion, FollowsTheTrapezoid) {
  StepperMotion motion;
  motion.add(kLong, 10.0);
  motion.advanceTo(10.25);
  EXPECT_EQ(motion.steps(), 12);  // 400 t^2 / 2 = 12.5
  EXPECT_NEAR(motion.speed(), 100.0, 1e-9);
  motion.advanceTo(12.5);
  EXPECT_EQ(motion.steps(), 450);  // 50 + 2 s at 200
  EXPECT_NEAR(motion.speed(), 200.0, 1e-9);
  motion.advanceTo(15.25);
  EXPECT_EQ(motion.steps(), 987);
  EXPECT_TRUE(motion.moving());
  motion.advanceTo(15.5001);
  EXPECT_EQ(motion.steps(), 1000);
  EXPECT_FALSE(motion.moving());
  EXPECT_TRUE(motion.empty());
}

TEST(StepperMotion, ShortWaysPeakBelowTheSpeed) {
  StepperMotion motion;
  motion.add({-4, 200.0, 400.0}, 0.0);
  motion.advanceTo(0.1);  // the peak: sqrt(400 * 4) = 40, reached after 0.1 s
  EXPECT_NEAR(motion.speed(), 40.0, 1e-9);
  EXPECT_EQ(motion.direction(), -1);
  motion.advanceTo(0.2001);
  EXPECT_EQ(motion.steps(), -4);
}

TEST(StepperMotion, RunsThroughItsQueueInOneStride) {
  StepperMotion motion;
  motion.add(kLong, 0.0);
  motion.add({0, 200.0, 400.0}, 0.0);
  motion.add({0, 200.0, 400.0}, 0.0);
  motion.advanceTo(5.5 + 0.25);
  EXPECT_EQ(motion.steps(), 988);  // on the way back
  motion.advanceTo(100.0);
  EXPECT_EQ(motion.steps(), 0);
  EXPECT_TRUE(motion.empty());
}

TEST(StepperMotion, HoldSlowsDownAndResumeArrives) {
  StepperMotion motion;
  motion.add(kLong, 0.0);
  motion.hold(2.0);  // at 350 steps, 200/s: 50 steps and 0.5 s to rest
  EXPECT_TRUE(motion.moving());
  motion.advanceTo(2.25);
  EXPECT_EQ(motion.steps(), 387);
  EXPECT_NEAR(motion.speed(), 100.0, 1e-9);
  motion.advanceTo(20.0);
  EXPECT_FALSE(motion.moving());
  EXPECT_NEAR(static_cast<double>(motion.steps()), 400.0, 1.0);
  EXPECT_FALSE(motion.empty());
  motion.resume(20.0);
  motion.advanceTo(40.0);
  EXPECT_EQ(motion.steps(), 1000);
}

TEST(StepperMotion, HoldNeverPassesTheTarget) {
  StepperMotion motion;
  motion.add(kLong, 0.0);
  motion.hold(5.4);
  motion.advanceTo(20.0);
  EXPECT_LE(motion.steps(), 1000);
  EXPECT_GE(motion.steps(), 999);
}

TEST(StepperMotion, NothingStartsWhileHeld) {
  StepperMotion motion;
  motion.hold(0.0);
  motion.add(kLong, 0.0);
  motion.advanceTo(5.0);
  EXPECT_EQ(motion.steps(), 0);
  motion.flush();
  EXPECT_FALSE(motion.held());
  motion.advanceTo(50.0);
  EXPECT_EQ(motion.steps(), 0);
}

TEST(StepperMotion, StopDeadForgetsTheQueue) {
  StepperMotion motion;
  motion.add(kLong, 0.0);
  motion.add({0, 200.0, 400.0}, 0.0);
  motion.advanceTo(2.0);
  motion.stopDead();
  motion.advanceTo(50.0);
  EXPECT_EQ(motion.steps(), 350);
}

TEST(StepperMotion, MoveToWhereItStandsTakesNoTime) {
  StepperMotion motion;
  motion.add({0, 200.0, 400.0}, 1.0);
  motion.advanceTo(1.0);
  EXPECT_FALSE(motion.moving());
  EXPECT_TRUE(motion.empty());
}

}  // namespace
}  // namespace gyre
