// The simulated boards against what is known of the real ones' wires, quirks included.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/firmware_boards.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/line_board.h"

namespace gyre {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// A terminal at a board that has booted.
class Terminal {
 public:
  explicit Terminal(const std::string& firmware)
      : board_(makeFirmwareBoard(firmware, TurntableFirmwareOptions{}, shaft_)) {
    board_->reset(0.0);
    greeting_ = wait(1.0);
  }
  // What is answered within the time.
  std::string say(std::string_view bytes, double seconds = 0.01) {
    board_->receive(std::as_bytes(std::span(bytes)), time_s_);
    return wait(seconds);
  }
  std::string wait(double seconds) {
    const double end_s = time_s_ + seconds;
    std::string heard;
    for (; time_s_ < end_s; time_s_ += 0.002) {
      board_->advanceTo(time_s_);
      heard += board_->takeOutput();
    }
    return heard;
  }
  std::int64_t steps() const { return shaft_->steps(); }
  const std::string& greeting() const { return greeting_; }
  FirmwareBoard& board() { return *board_; }
  double seconds() const { return time_s_; }

 private:
  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  std::unique_ptr<FirmwareBoard> board_;
  double time_s_ = 0.0;
  std::string greeting_;
};

TEST(FirmwareBoards, EachNameHasABoardAndNoOtherHas) {
  for (const std::string& name : firmwareBoardNames()) {
    EXPECT_NE(makeFirmwareBoard(name, TurntableFirmwareOptions{}, std::make_shared<Shaft>()),
              nullptr);
  }
  EXPECT_EQ(makeFirmwareBoard("klipper", TurntableFirmwareOptions{}, std::make_shared<Shaft>()),
            nullptr);
}

TEST(FirmwareBoards, WhatArrivesWhileABoardBootsIsLost) {
  auto board =
      makeFirmwareBoard("sardauscan", TurntableFirmwareOptions{}, std::make_shared<Shaft>());
  board->reset(0.0);
  const std::string_view question = "T S\n";
  board->receive(std::as_bytes(std::span(question)), 0.1);
  board->advanceTo(2.0);
  EXPECT_EQ(board->takeOutput(), "Sardauscan V0.1a\r\n");
}

TEST(HorusBoard, SaysOkWhenAMoveIsPlannedAndToALaserWhenItHasEnded) {
  Terminal terminal("horus");
  EXPECT_EQ(terminal.greeting(), "\r\nHorus 0.2 ['$' for help]\r\n");
  EXPECT_EQ(terminal.say("M17\n"), "ok\r\n");
  EXPECT_EQ(terminal.say("G1F20\n"), "ok\r\n");
  EXPECT_EQ(terminal.say("G1X90\n"), "ok\r\n");
  EXPECT_LT(terminal.steps(), 10);
  EXPECT_THAT(terminal.say("M70T1\n", 1.0), IsEmpty());
  EXPECT_EQ(terminal.wait(6.0), "ok\r\n");
  EXPECT_EQ(terminal.steps(), 800);
}

TEST(HorusBoard, EmptyLineGetsNoOkAndAWrongOneWords) {
  Terminal terminal("horus");
  EXPECT_THAT(terminal.say("\r\n\r\n"), IsEmpty());
  EXPECT_EQ(terminal.say("G99\n"), "error: Unsupported command\r\n");
  EXPECT_EQ(terminal.say("\x18"), "\r\nHorus 0.2 ['$' for help]\r\n");
}

TEST(MarlinBoard, AsksAgainForALineWithAWrongSum) {
  Terminal terminal("marlin");
  EXPECT_THAT(terminal.greeting(), StartsWith("start\r\n"));
  EXPECT_EQ(terminal.say("M110 N0\n"), "ok\r\n");
  const std::string wrong = terminal.say("N1 M400*1\n");
  EXPECT_THAT(wrong, HasSubstr("Error:checksum mismatch, Last Line: 0"));
  EXPECT_THAT(wrong, EndsWith("Resend: 1\r\nok\r\n"));
  // XOR of the characters of "N1 M400".
  unsigned sum = 0;
  for (const char c : std::string("N1 M400")) sum ^= static_cast<unsigned>(c);
  EXPECT_EQ(terminal.say("N1 M400*" + std::to_string(sum) + "\n"), "ok\r\n");
}

TEST(MarlinBoard, WaitsForTheEndOfMotionAndSaysThatItIsBusy) {
  Terminal terminal("marlin");
  EXPECT_EQ(terminal.say("G1 X90 F1200\n"), "ok\r\n");
  EXPECT_EQ(terminal.say("M400\n", 4.0), "echo:busy: processing\r\n");
  EXPECT_THAT(terminal.wait(2.0), EndsWith("ok\r\n"));
  EXPECT_EQ(terminal.steps(), 800);
  EXPECT_THAT(terminal.say("M114\n"), HasSubstr("Count X:800 "));
  EXPECT_THAT(terminal.say("G123\n"), HasSubstr("echo:Unknown command: \"G123\""));
}

TEST(FabScanBoard, RepeatsAndSaysThePromptAfterTheMove) {
  Terminal terminal("fabscan");
  EXPECT_THAT(terminal.greeting(), IsEmpty());
  EXPECT_EQ(terminal.say("M200\n"), "M200\nv.20170721\r\n>\r\n");
  EXPECT_EQ(terminal.say("M17\n"), "M17\n>\r\n");
  EXPECT_EQ(terminal.say("G2 T800 F200\n", 0.5), "G2 T800 F200\n");
  EXPECT_EQ(terminal.wait(5.0), ">\r\n");
  EXPECT_EQ(terminal.steps(), 800);
}

TEST(FabScanBoard, TakesWholeNumbersOfWordsThatStandApart) {
  Terminal terminal("fabscan");
  terminal.say("M17\n");
  terminal.say("G1 T-44.44 F200\n", 2.0);
  EXPECT_EQ(terminal.steps(), -44);
  terminal.say("G1T100\n", 2.0);
  EXPECT_EQ(terminal.steps(), -44);
}

TEST(FabScanBoard, MotorIsOffUntilItIsSwitchedOn) {
  Terminal terminal("fabscan");
  EXPECT_THAT(terminal.say("G1 T100 F200\n", 2.0), EndsWith(">\r\n"));
  EXPECT_EQ(terminal.steps(), 0);
}

TEST(SardauscanBoard, AnswersAfterTheMotionWithWhereItStands) {
  Terminal terminal("sardauscan");
  EXPECT_EQ(terminal.say("sardauscan\n"), "yes\r\n");
  EXPECT_EQ(terminal.say("T S\n"), "REVOLUTION STEPS  => 3200\r\n");
  EXPECT_THAT(terminal.say("T R 400\n", 0.2), IsEmpty());
  EXPECT_EQ(terminal.wait(3.0), "RELATIVE ROTATION :400 => 400\r\n");
  EXPECT_EQ(terminal.say("T\n"), "Position 400\r\n");
  EXPECT_EQ(terminal.say("T A 100\n", 3.0), "ABSOLUTE ROTATION 100 => 100\r\n");
  EXPECT_EQ(terminal.say("X\n"), "Hun?\r\n");
}

TEST(ArtivactBoard, DropsTheRemainderOfEachMove) {
  Terminal terminal("artivact");
  EXPECT_EQ(terminal.say("VERSION\n"), "ARTIVACT_TT_V2\r\n");
  for (int i = 0; i < 36; ++i) EXPECT_EQ(terminal.say("MOVE 36\n", 2.0), "OK\r\n");
  EXPECT_EQ(terminal.steps(), 12288 - 12);
  EXPECT_EQ(terminal.say("MOVE\n"), "ERR\r\n");
  EXPECT_THAT(terminal.say("HELLO\n"), IsEmpty());
}

TEST(ComXimBoard, AnswersAMoveTwiceAndNothingToDoOnce) {
  Terminal terminal("comxim");
  EXPECT_EQ(terminal.say("CT+TRUNSINGLE(1,22.5);"), "CR+OK;");
  EXPECT_EQ(terminal.wait(3.0), "CR+EVENT=TB_PAUSE;CR+EVENT=TB_END;");
  EXPECT_EQ(terminal.steps(), 900);
  EXPECT_EQ(terminal.say("CT+SETZERO();"), "CR+OK;");
  EXPECT_EQ(terminal.say("CT+TOZERO();", 3.0), "CR+OK;");
  EXPECT_EQ(terminal.say("CT+TRUNSINGLE(0,10);", 3.0), "CR+OK;CR+EVENT=TB_PAUSE;CR+EVENT=TB_END;");
  EXPECT_EQ(terminal.say("CT+TOZERO();", 3.0), "CR+OK;CR+EVENT=TB_PAUSE;CR+EVENT=TB_END;");
  EXPECT_EQ(terminal.steps(), 900);
}

TEST(LineBoard, OccupiedBoardObeysNothingUntilItIsFree) {
  Terminal terminal("sardauscan");
  auto& board = dynamic_cast<LineBoard&>(terminal.board());
  board.occupy(2.0, terminal.seconds());
  EXPECT_TRUE(board.busy());
  EXPECT_THAT(terminal.say("T S\n", 1.5), IsEmpty());
  EXPECT_THAT(terminal.wait(1.0), HasSubstr("3200"));
}

TEST(LineBoard, LineThatDoesNotFitIntoTheBufferIsLost) {
  Terminal terminal("sardauscan");
  auto& board = dynamic_cast<LineBoard&>(terminal.board());
  board.occupy(1.0, terminal.seconds());
  for (int i = 0; i < 60; ++i) terminal.say("T S\n", 0.0);
  const std::string heard = terminal.wait(2.0);
  EXPECT_LT(heard.size(), 60U * std::string("REVOLUTION STEPS  => 3200\r\n").size());
  EXPECT_THAT(heard, Not(IsEmpty()));
}

}  // namespace
}  // namespace gyre
