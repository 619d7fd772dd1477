// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl_link.h"

#include <array>
#include <string>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/device/protocols/grbl_handshake.h"
#include "core/sim/pipe_port.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using Code = Error::Code;

// The test speaks for the board: what it says before the question is read as the answer.
class GrblLinkTest : public testing::Test {
 protected:
  GrblLinkTest() : GrblLinkTest(PipePort::makePair("board")) {}
  void boardSays(std::string_view text) {
    ASSERT_TRUE(board_->write(std::as_bytes(std::span(text)), 0.1));
  }
  std::string boardHears() {
    std::array<std::byte, 64> buffer{};
    std::string text;
    const Result<std::size_t> count = board_->read(buffer, 0.0);
    for (const std::byte byte : std::span(buffer).first(*count)) text += static_cast<char>(byte);
    return text;
  }

 private:
  explicit GrblLinkTest(std::pair<std::unique_ptr<PipePort>, std::unique_ptr<PipePort>> ends)
      : board_(std::move(ends.second)), link_(std::move(ends.first)) {}

 protected:
  std::unique_ptr<PipePort> board_;
  GrblLink link_;
};

TEST_F(GrblLinkTest, OkIsSuccess) {
  boardSays("ok\r\n");
  EXPECT_TRUE(link_.command("G4P0", 1.0, {}));
  EXPECT_EQ(boardHears(), "G4P0\n");
}

TEST_F(GrblLinkTest, QueryGivesWhatWasSaidBefore) {
  boardSays("$100=8.889\r\n[MSG:x]\r\nok\r\n");
  const auto said = link_.query("$$", 1.0, {});
  ASSERT_TRUE(said);
  ASSERT_EQ(said->size(), 2U);
  EXPECT_EQ((*said)[0].number, 100);
}

TEST_F(GrblLinkTest, ErrorIsARejectionInWords) {
  boardSays("error:9\r\n");
  const Result<void> answer = link_.command("G0X1", 1.0, {});
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, Code::kRejected);
  EXPECT_THAT(answer.error().what, HasSubstr("locked"));
}

TEST_F(GrblLinkTest, AlarmIsTroubleUntilForgiven) {
  boardSays("ALARM:1\r\n\r\nGrbl 1.1h ['$' for help]\r\n");
  EXPECT_EQ(link_.command("G0X1", 1.0, {}).error().code, Code::kAlarm);
  ASSERT_TRUE(link_.drain());
  EXPECT_THAT(link_.trouble()->what, HasSubstr("limit switch"));  // says more than the restart
  EXPECT_EQ(link_.status(1.0, {}).error().code, Code::kAlarm);
  link_.forgiveTrouble();
  boardSays("ok\r\n");
  EXPECT_TRUE(link_.command("$X", 1.0, {}));
}

TEST_F(GrblLinkTest, SilenceIsATimeout) {
  const double begin_s = steadySeconds();
  EXPECT_EQ(link_.command("$I", 0.1, {}).error().code, Code::kTimeout);
  EXPECT_EQ(link_.status(0.1, {}).error().code, Code::kTimeout);
  EXPECT_LT(steadySeconds() - begin_s, 0.5);
}

TEST_F(GrblLinkTest, WaitsEndWhenInterrupted) {
  const double begin_s = steadySeconds();
  EXPECT_EQ(link_.command("$I", 10.0, [] { return true; }).error().code, Code::kCancelled);
  EXPECT_EQ(link_.status(10.0, [] { return true; }).error().code, Code::kCancelled);
  EXPECT_LT(steadySeconds() - begin_s, 0.5);
}

TEST_F(GrblLinkTest, PulledCableIsGone) {
  board_.reset();
  EXPECT_EQ(link_.command("$I", 1.0, {}).error().code, Code::kGone);
  EXPECT_EQ(link_.status(1.0, {}).error().code, Code::kGone);
  EXPECT_EQ(link_.drain().error().code, Code::kGone);
}

TEST_F(GrblLinkTest, WorkPositionsBecomeMachinePositions) {
  boardSays("<Idle|WPos:1.000,2.000,0.000|FS:0,0>\r\n");  // no offset known yet: not usable
  boardSays("<Idle|WPos:1.000,2.000,0.000|FS:0,0|WCO:10.000,0.000,0.000>\r\n");
  const Result<GrblStatus> status = link_.status(1.0, {});
  ASSERT_TRUE(status);
  EXPECT_EQ(status->machine[0], 11.0);
}

TEST_F(GrblLinkTest, HandshakeLeavesAMovingBoardAlone) {
  boardSays("<Run|MPos:1.000,0.000,0.000|FS:500,0>\r\n");
  // The report is read while waiting for a greeting; another one answers the question.
  std::jthread board([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::array<std::byte, 8> buffer{};
      const Result<std::size_t> count = board_->read(buffer, 0.01);
      if (count && *count > 0) {
        EXPECT_EQ(buffer[0], std::byte{'?'});  // and never a reset
        boardSays("<Run|MPos:1.000,0.000,0.000|FS:500,0>\r\n");
      }
    }
  });
  const Result<GrblBoardInfo> board_info = identifyGrbl(link_, 0.1, {});
  ASSERT_FALSE(board_info);
  EXPECT_EQ(board_info.error().code, Code::kBusy);
}

TEST_F(GrblLinkTest, HandshakeRefusesOldFirmware) {
  boardSays("\r\nGrbl 0.9j ['$' for help]\r\n");
  const Result<GrblBoardInfo> board_info = identifyGrbl(link_, 0.1, {});
  ASSERT_FALSE(board_info);
  EXPECT_EQ(board_info.error().code, Code::kWrongDevice);
  EXPECT_THAT(board_info.error().what, HasSubstr("Grbl 0.9j"));
}

}  // namespace
}  // namespace gyre
