// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/turntable_axis.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(TurntableAxis, ReadsTheSettingsOfItsLetter) {
  TurntableOptions options;
  options.axis = "Y";
  const auto axis = turntableAxis({{101, 8.889}, {111, 600.0}, {121, 50.0}}, options);
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->letter, 'Y');
  EXPECT_EQ(axis->index, 1U);
  EXPECT_DOUBLE_EQ(axis->steps_per_turn, 3200.0);  // what three decimals hide
  EXPECT_DOUBLE_EQ(axis->feed_units_per_s, 10.0);  // the board's limit is below the wish
  EXPECT_DOUBLE_EQ(axis->acceleration_units_per_s2, 50.0);
}

TEST(TurntableAxis, RefusesABoardThatDoesNotTellItsSteps) {
  EXPECT_FALSE(turntableAxis({{101, 250.0}}, {}));
  TurntableOptions told;
  told.steps_per_turn = 6400.0;
  EXPECT_DOUBLE_EQ(turntableAxis({}, told)->steps_per_turn, 6400.0);
}

TEST(CorrectedOptions, MakeOneRadianToldOneRadianTurned) {
  // GRBL's default of 250 steps a unit, and a motor of 3200 steps a turn: a degree told turns 28.
  const TurntableOptions corrected = correctedOptions({}, -28.125);
  EXPECT_DOUBLE_EQ(corrected.units_per_turn, 12.8);
  EXPECT_EQ(corrected.direction, -1);
  EXPECT_DOUBLE_EQ(turntableAxis({{100, 250.0}}, corrected)->steps_per_turn, 3200.0);
}

}  // namespace
}  // namespace gyre
