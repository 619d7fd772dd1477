// Expected replies: grbl/doc/markdown/{interface,commands,jogging}.md, not the code under test.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/grbl_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr char kSoftReset = 0x18;

// A board that has booted, 3200 steps a turn, 60 deg/s, 120 deg/s^2.
class GrblBoardTest : public testing::Test {
 protected:
  GrblBoardTest() {
    board_.reset(0.0);
    wait(1.0);
    board_.takeOutput();
  }
  std::string say(std::string_view text) {
    board_.receive(std::as_bytes(std::span(text)), now_s_);
    return board_.takeOutput();
  }
  std::string wait(double seconds) {
    now_s_ += seconds;
    board_.advanceTo(now_s_);
    return board_.takeOutput();
  }

  double now_s_ = 0.0;
  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  GrblBoard board_{TurntableFirmwareOptions{}, shaft_};
};

TEST_F(GrblBoardTest, GreetsAfterBootingAndHearsNothingBefore) {
  board_.reset(now_s_);
  EXPECT_EQ(say("?$I\n"), "");
  EXPECT_EQ(wait(0.39), "");
  EXPECT_EQ(wait(0.02), "\r\nGrbl 1.1h ['$' for help]\r\n");
  EXPECT_EQ(wait(1.0), "");
}

TEST_F(GrblBoardTest, ReportsStateAndPosition) {
  EXPECT_THAT(say("?"), StartsWith("<Idle|MPos:0.000,0.000,0.000|FS:0,0"));
  EXPECT_EQ(say("G1X90F1200\n"), "ok\r\n");
  wait(1.0);
  EXPECT_THAT(say("?"), StartsWith("<Run|MPos:"));
  EXPECT_THAT(say("?"), HasSubstr("|FS:1200,0"));
  wait(10.0);
  EXPECT_THAT(say("?"), StartsWith("<Idle|MPos:89.999,0.000,0.000|FS:0,0"));
  EXPECT_EQ(shaft_->steps(), 800);
}

TEST_F(GrblBoardTest, OkIsNotArrival) {
  EXPECT_EQ(say("G0X90\n"), "ok\r\n");
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, DwellIsABarrier) {
  say("G1X20F1200\n");  // 1 s at 20 deg/s and 1/6 s to change speed
  EXPECT_EQ(say("G4P0.01\n"), "");
  EXPECT_EQ(wait(1.1), "");
  EXPECT_EQ(wait(0.1), "");  // dwells
  EXPECT_EQ(wait(0.02), "ok\r\n");
  EXPECT_EQ(shaft_->steps(), 178);  // 20 * 8.889
}

TEST_F(GrblBoardTest, FullPlannerHoldsBackItsOk) {
  std::string said;
  for (int i = 1; i <= 15; ++i) said += say("G1X" + std::to_string(i) + "F600\n");
  EXPECT_EQ(said.size(), 15 * 4U);
  EXPECT_EQ(say("G1X16F600\n"), "");
  EXPECT_EQ(wait(0.5), "ok\r\n");
}

TEST_F(GrblBoardTest, HoldSlowsDownAndCycleStartGoesOn) {
  say("G1X90F1200\n");
  wait(1.0);
  say("!");
  EXPECT_THAT(say("?"), StartsWith("<Hold:1|"));
  wait(0.5);
  EXPECT_THAT(say("?"), StartsWith("<Hold:0|"));
  const std::int64_t held_at = shaft_->steps();
  EXPECT_EQ(wait(10.0), "");
  EXPECT_EQ(shaft_->steps(), held_at);
  say("~");
  EXPECT_THAT(say("?"), StartsWith("<Run|"));
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), 800);
}

TEST_F(GrblBoardTest, ResetAfterHoldKeepsThePosition) {
  say("G1X90F1200\n");
  wait(1.0);
  say("!");
  wait(1.0);
  const std::int64_t held_at = shaft_->steps();
  EXPECT_EQ(say({&kSoftReset, 1}), "\r\nGrbl 1.1h ['$' for help]\r\n");
  EXPECT_THAT(say("?"), StartsWith("<Idle|MPos:"));
  EXPECT_THAT(say("?"), Not(HasSubstr("MPos:0.000")));
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), held_at);
}

TEST_F(GrblBoardTest, ResetInMotionRaisesAlarm3AndLosesSteps) {
  say("G1X90F1200\n");
  wait(1.0);
  const std::int64_t before = shaft_->steps();
  EXPECT_EQ(say({&kSoftReset, 1}), "ALARM:3\r\n");
  EXPECT_EQ(wait(0.7), "");  // the alarm's pause, and letting go of the motor
  EXPECT_EQ(wait(0.1), "\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\n");
  EXPECT_GT(shaft_->steps(), before);  // ran on, uncounted
  EXPECT_THAT(say("?"), StartsWith("<Alarm|"));
  EXPECT_EQ(say("G0X1\n"), "error:9\r\n");
  EXPECT_EQ(say("$X\n"), "[MSG:Caution: Unlocked]\r\nok\r\n");
  EXPECT_EQ(say("G0X1\n"), "ok\r\n");
}

TEST_F(GrblBoardTest, OpeningThePortCountsFromZeroAndLeavesTheShaft) {
  say("G0X90\n");
  wait(10.0);
  board_.reset(now_s_);
  wait(1.0);
  EXPECT_THAT(say("?"), StartsWith("<Idle|MPos:0.000"));
  EXPECT_EQ(shaft_->steps(), 800);
  say("G0X90\n");
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), 1600);
}

TEST_F(GrblBoardTest, AnswersQuestions) {
  EXPECT_EQ(say("$I\n"), "[VER:1.1h.20190825:]\r\n[OPT:V,15,128]\r\nok\r\n");
  const std::string settings = say("$$\n");
  EXPECT_THAT(settings, HasSubstr("$1=255\r\n"));
  EXPECT_THAT(settings, HasSubstr("$100=8.889\r\n"));
  EXPECT_THAT(settings, HasSubstr("$110=3600.000\r\n"));
  EXPECT_THAT(settings, HasSubstr("$120=120.000\r\n"));
  EXPECT_THAT(say("$G\n"), StartsWith("[GC:G0 G54 G17 G21 G90 G94"));
  EXPECT_THAT(say("$\n"), StartsWith("[HLP:"));
  EXPECT_EQ(say("\n"), "ok\r\n");
  EXPECT_EQ(say("(a comment) ; and another\n"), "ok\r\n");
  EXPECT_EQ(say(" m5 s0 g21\n"), "ok\r\n");
}

TEST_F(GrblBoardTest, SettingsOutliveAReset) {
  EXPECT_EQ(say("$110=1800\n"), "ok\r\n");
  board_.reset(now_s_);
  wait(1.0);
  EXPECT_THAT(say("$$\n"), HasSubstr("$110=1800.000\r\n"));
}

TEST_F(GrblBoardTest, NamesItsErrors) {
  EXPECT_EQ(say("5\n"), "error:1\r\n");
  EXPECT_EQ(say("G1XF600\n"), "error:2\r\n");
  EXPECT_EQ(say("$Q\n"), "error:3\r\n");
  EXPECT_EQ(say("$999=1\n"), "error:3\r\n");
  EXPECT_EQ(say("$110=-1\n"), "error:4\r\n");
  EXPECT_EQ(say("$110=fast\n"), "error:2\r\n");
  EXPECT_EQ(say("$H\n"), "error:5\r\n");
  EXPECT_EQ(say("G0X1" + std::string(90, ' ') + "\n"), "error:11\r\n");
  EXPECT_EQ(say("$J=G1X1F600\n"), "error:16\r\n");
  EXPECT_EQ(say("G2X1\n"), "error:20\r\n");
  EXPECT_EQ(say("M17\n"), "error:20\r\n");
  EXPECT_EQ(say("G0G1X1\n"), "error:21\r\n");
  EXPECT_EQ(say("G1X1\n"), "error:22\r\n");
  EXPECT_EQ(say("G0X1X2\n"), "error:25\r\n");
  EXPECT_EQ(say("$J=F600\n"), "error:26\r\n");
  EXPECT_EQ(say("G4\n"), "error:28\r\n");
  wait(5.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, RefusesQuestionsWhileTurning) {
  say("G1X90F1200\n");
  EXPECT_EQ(say("$$\n"), "error:8\r\n");
  EXPECT_EQ(say("$J=G91X1F600\n"), "error:8\r\n");
}

TEST_F(GrblBoardTest, JogsAndCancelsWithoutLosingThePosition) {
  EXPECT_EQ(say("$J=G91X90F1200\n"), "ok\r\n");
  wait(1.0);
  EXPECT_THAT(say("?"), StartsWith("<Jog|"));
  EXPECT_EQ(say("G0X0\n"), "error:9\r\n");
  say("\x85");
  wait(1.0);
  EXPECT_THAT(say("?"), StartsWith("<Idle|"));
  const std::int64_t stands = shaft_->steps();
  EXPECT_GT(stands, 0);
  EXPECT_LT(stands, 400);
  say("$J=G90X0F1200\n");
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, KnowsRelativeOffsetAndMachinePositions) {
  say("G91G0X10\nG0X10\n");
  wait(5.0);
  EXPECT_THAT(say("?"), HasSubstr("MPos:20.025"));  // 178 steps
  say("G92X0\nG90G0X10\n");
  wait(5.0);
  EXPECT_EQ(shaft_->steps(), 267);  // 30 degrees
  EXPECT_THAT(say("$#\n"), HasSubstr("[G92:20.000,0.000,0.000]"));
  say("G91G53G0X0\n");
  wait(5.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, LimitSwitchRaisesAlarm1UntilReset) {
  board_.pressLimitSwitch(now_s_);
  EXPECT_EQ(wait(0.1), "");  // $21 is off
  say("$21=1\nG1X90F1200\n");
  wait(1.0);
  board_.pressLimitSwitch(now_s_);
  EXPECT_THAT(wait(0.0), StartsWith("ALARM:1\r\n"));
  const std::int64_t stands = shaft_->steps();
  EXPECT_EQ(say("$X\n?"), "");
  EXPECT_THAT(say({&kSoftReset, 1}), HasSubstr("to unlock"));
  EXPECT_THAT(say("$X\n"), HasSubstr("ok"));
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), stands);
}

TEST_F(GrblBoardTest, SoftLimitsRefuse) {
  say("$20=1\n");
  EXPECT_EQ(say("$J=G91X10F600\n"), "error:15\r\n");
  EXPECT_THAT(say("G0X10\n"), StartsWith("ALARM:2\r\n"));
  wait(5.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, SleepsUntilReset) {
  EXPECT_EQ(say("$SLP\n"), "ok\r\n[MSG:Sleeping]\r\n");
  EXPECT_THAT(say("?"), StartsWith("<Sleep|"));
  EXPECT_EQ(say("G0X10\n"), "");
  EXPECT_EQ(say({&kSoftReset, 1}), "");
  EXPECT_THAT(wait(0.3), HasSubstr("to unlock"));
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(GrblBoardTest, DirectionCanBeInverted) {
  say("$3=1\nG0X90\n");
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), -800);
}

TEST_F(GrblBoardTest, SplitLinesAndRealtimeCharactersWithinThemAreUnderstood) {
  EXPECT_EQ(say("G1X9"), "");
  EXPECT_THAT(say("0F?12"), StartsWith("<Idle|"));
  EXPECT_EQ(say("00\n"), "ok\r\n");
  wait(10.0);
  EXPECT_EQ(shaft_->steps(), 800);
}

TEST(GrblBoardWithPlay, TurnsBackWhereItShallHoweverLongNobodyLooks) {
  const auto loose = std::make_shared<Shaft>(30);
  GrblBoard board(TurntableFirmwareOptions{}, loose);
  board.reset(0.0);
  board.advanceTo(1.0);
  const std::string back_and_forth = "G90G1X-20.25F3600\nG1X-18F3600\n";  // 180 and 160 steps
  board.receive(std::as_bytes(std::span(back_and_forth)), 1.0);
  board.advanceTo(60.0);
  EXPECT_EQ(loose->steps(), -160);
  EXPECT_EQ(loose->tableSteps(), -150);
}

}  // namespace
}  // namespace gyre
