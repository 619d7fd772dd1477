// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/gcode.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

using Kind = GcodeCommand::Kind;

TEST(Gcode, MovesAreAbsoluteUntilToldOtherwise) {
  GcodeState state;
  GcodeCommand command;
  ASSERT_EQ(readGcode("G1X10F600", state, command), 0);
  EXPECT_EQ(command.kind, Kind::kMove);
  EXPECT_EQ(command.target[0], 10.0);
  EXPECT_EQ(command.feed, 600.0);
  ASSERT_EQ(readGcode("G91X5", state, command), 0);  // G1 and F stay in force
  EXPECT_EQ(command.target[0], 15.0);
  EXPECT_EQ(command.feed, 600.0);
  ASSERT_EQ(readGcode("G0X-1", state, command), 0);
  EXPECT_EQ(command.target[0], 14.0);
  EXPECT_EQ(command.feed, 0.0);
}

TEST(Gcode, OffsetsShiftWorkPositionsOnly) {
  GcodeState state;
  GcodeCommand command;
  ASSERT_EQ(readGcode("G0X20", state, command), 0);
  ASSERT_EQ(readGcode("G92X0", state, command), 0);
  EXPECT_EQ(command.kind, Kind::kNothing);
  ASSERT_EQ(readGcode("G0X5", state, command), 0);
  EXPECT_EQ(command.target[0], 25.0);
  ASSERT_EQ(readGcode("G53G0X5", state, command), 0);
  EXPECT_EQ(command.target[0], 5.0);
  ASSERT_EQ(readGcode("G92.1", state, command), 0);
  ASSERT_EQ(readGcode("G0X5", state, command), 0);
  EXPECT_EQ(command.target[0], 5.0);
}

TEST(Gcode, InchesScaleLengthsAndFeeds) {
  GcodeState state;
  GcodeCommand command;
  ASSERT_EQ(readGcode("G20G1X1F2", state, command), 0);
  EXPECT_DOUBLE_EQ(command.target[0], 25.4);
  EXPECT_DOUBLE_EQ(command.feed, 50.8);
}

TEST(Gcode, DwellTakesItsSeconds) {
  GcodeState state;
  GcodeCommand command;
  ASSERT_EQ(readGcode("G4P0.25", state, command), 0);
  EXPECT_EQ(command.kind, Kind::kDwell);
  EXPECT_EQ(command.dwell_s, 0.25);
}

TEST(Gcode, JogsLeaveTheModesAlone) {
  GcodeState state;
  GcodeCommand command;
  ASSERT_EQ(readJog("G91X5F600", state, command), 0);
  EXPECT_EQ(command.target[0], 5.0);
  EXPECT_TRUE(state.absolute);
  EXPECT_EQ(state.feed, 0.0);
  EXPECT_EQ(state.position[0], 5.0);
  EXPECT_EQ(readJog("X5", state, command), 22);
}

TEST(Gcode, ErrorsLeaveTheStateAlone) {
  GcodeState state;
  GcodeCommand command;
  for (const char* line : {"G91X", "G91G1X1", "G91Q1", "G91X1X2", "G91M17", "X1e400", "G91\xff"}) {
    EXPECT_NE(readGcode(line, state, command), 0) << line;
    EXPECT_TRUE(state.absolute) << line;
    EXPECT_EQ(state.position[0], 0.0) << line;
  }
}

}  // namespace
}  // namespace gyre
