// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/grbl_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(GrblSettings, FollowTheMotorAndRoundAsTheFirmwareDoes) {
  TurntableFirmwareOptions options;
  options.steps_per_turn = 6400.0;
  options.max_speed_deg_per_s = 30.0;
  const GrblSettings settings(options);
  EXPECT_EQ(settings.value(GrblSettings::kStepsPerUnit), 17.778);  // 17.7777...
  EXPECT_EQ(settings.value(GrblSettings::kMaxRate), 1800.0);
  EXPECT_EQ(settings.value(1), 255.0);  // the motor stays on
}

TEST(GrblSettings, AreSetAndReported) {
  GrblSettings settings({});
  EXPECT_EQ(settings.assign("$120=77.12345"), 0);
  EXPECT_EQ(settings.assign("$1=25"), 0);
  EXPECT_THAT(settings.report(), HasSubstr("$120=77.123\r\n"));
  EXPECT_THAT(settings.report(), HasSubstr("$1=25\r\n"));
}

TEST(GrblSettings, RefuseWhatTheFirmwareRefuses) {
  GrblSettings settings({});
  const std::string before = settings.report();
  EXPECT_EQ(settings.assign("$100"), 3);
  EXPECT_EQ(settings.assign("$x=1"), 3);
  EXPECT_EQ(settings.assign("$7777=1"), 3);
  EXPECT_EQ(settings.assign("$100=0"), 3);
  EXPECT_EQ(settings.assign("$100="), 2);
  EXPECT_EQ(settings.assign("$100=inf"), 2);
  EXPECT_EQ(settings.assign("$100=-8"), 4);
  EXPECT_EQ(settings.report(), before);
}

}  // namespace
}  // namespace gyre
