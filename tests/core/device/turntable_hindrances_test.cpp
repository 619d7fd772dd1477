// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/turntable_hindrances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(WholeStepsPerTurn, SeesThroughThreeDecimals) {
  EXPECT_EQ(wholeStepsPerTurn(8.889, 360.0), 3200.0);
  EXPECT_EQ(wholeStepsPerTurn(17.778, 360.0), 6400.0);
  EXPECT_EQ(wholeStepsPerTurn(53.333, 360.0), 19200.0);  // 1 deg in 444 turns, if taken at its word
  EXPECT_DOUBLE_EQ(wholeStepsPerTurn(8.8903, 360.0), 8.8903 * 360.0);
}

TEST(TurntableHindrances, NoneForABoardSetUpForATable) {
  EXPECT_THAT(turntableHindrances(
                  {{1, 255}, {20, 0}, {21, 0}, {22, 0}, {32, 0}, {100, 8.889}, {110, 3600}}, {}),
              IsEmpty());
  EXPECT_THAT(turntableHindrances({}, {}), IsEmpty());
}

TEST(TurntableHindrances, EachSettingThatHindersIsNamedWithItsCure) {
  EXPECT_THAT(turntableHindrances({{1, 25}, {20, 1}, {21, 1}, {22, 1}, {32, 1}}, {}),
              ElementsAre(HasSubstr("send $1=255"), HasSubstr("send $20=0"),
                          HasSubstr("send $21=0"), HasSubstr("send $22=0"), HasSubstr("$32=0")));
}

TEST(TurntableHindrances, LookAtTheAxisThatTurns) {
  TurntableOptions options;
  options.axis = "A";
  EXPECT_THAT(turntableHindrances({{103, 8.8903}, {113, 600}, {100, 1.1}, {110, 1}}, options),
              ElementsAre(HasSubstr("$103"), HasSubstr("$113")));
  options.steps_per_turn = 3200.5;  // measured
  options.speed_deg_per_s = 5.0;
  EXPECT_THAT(turntableHindrances({{103, 8.8903}, {113, 600}}, options), IsEmpty());
}

}  // namespace
}  // namespace gyre
