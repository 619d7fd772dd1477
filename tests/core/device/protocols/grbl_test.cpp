// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

using Kind = GrblMessage::Kind;
using testing::ElementsAre;
using testing::HasSubstr;

void feed(GrblParser& parser, std::string_view text) {
  parser.feed(std::as_bytes(std::span(text)));
}

std::vector<Kind> kindsIn(GrblParser& parser) {
  std::vector<Kind> kinds;
  while (const std::optional<GrblMessage> message = parser.next()) kinds.push_back(message->kind);
  return kinds;
}

TEST(GrblParser, TellsMessagesApart) {
  GrblParser parser;
  feed(parser,
       "\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\nok\r\nerror:9\r\nALARM:3\r\n"
       "$100=8.889\r\n<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n>G20:ok\r\nhello\r\n");
  EXPECT_THAT(kindsIn(parser),
              ElementsAre(Kind::kBanner, Kind::kFeedback, Kind::kOk, Kind::kError, Kind::kAlarm,
                          Kind::kSetting, Kind::kStatus, Kind::kFeedback, Kind::kGarbage));
}

TEST(GrblParser, ReadsNumbers) {
  EXPECT_EQ(parseGrblLine("error:15").number, 15);
  EXPECT_EQ(parseGrblLine("ALARM:1").number, 1);
  EXPECT_EQ(parseGrblLine("$100=8.889").number, 100);
  EXPECT_EQ(parseGrblLine("$100=8.889").value, 8.889);
}

TEST(GrblParser, ReadsStatus) {
  const GrblMessage message =
      parseGrblLine("<Hold:1|MPos:-1.500,2.000,3.000,4.000|FS:500,0|WCO:1.000,0.000,0.000,0.000>");
  ASSERT_EQ(message.kind, Kind::kStatus);
  EXPECT_EQ(message.status.state, GrblState::kHold);
  EXPECT_EQ(message.status.substate, 1);
  EXPECT_THAT(message.status.machine, ElementsAre(-1.5, 2.0, 3.0, 4.0));
  EXPECT_THAT(message.status.work_offset, ElementsAre(1.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(parseGrblLine("<Run|WPos:1,2,3|Bf:15,128>").status.work.size(), 3U);
}

TEST(GrblParser, MutilatedLinesAreGarbage) {
  for (const char* line :
       {"oK", "error:", "error:x", "error:1x", "ALARM:", "<Idle>", "<Idle|FS:0,0>",
        "<Idel|MPos:0,0,0>", "<Idle|MPos:0,x,0>", "<Idle|MPos:0,0,0", "$=1", "$100=", "$100=1,5",
        "$100=nan", "<Hold:x|MPos:0,0,0>", "Grbl", ""}) {
    EXPECT_EQ(parseGrblLine(line).kind, Kind::kGarbage) << line;
  }
}

TEST(GrblParser, WaitsForTheRestOfALine) {
  GrblParser parser;
  for (const char c : std::string("<Run|MPos:1.000,0.000,0.000|FS:0,0>\r")) {
    EXPECT_FALSE(parser.next());
    feed(parser, {&c, 1});
  }
  EXPECT_THAT(kindsIn(parser), ElementsAre(Kind::kStatus));
}

TEST(GrblParser, ResynchronisesAfterNoise) {
  Random random(7);
  GrblParser parser;
  std::string noise;
  for (int i = 0; i < 100000; ++i) noise += static_cast<char>(random.below(256));
  feed(parser, noise);
  feed(parser, std::string(5000, 'x'));
  feed(parser, "\nok\n");
  std::vector<Kind> kinds = kindsIn(parser);
  ASSERT_GE(kinds.size(), 2U);
  EXPECT_EQ(kinds.back(), Kind::kOk);
  EXPECT_EQ(kinds[kinds.size() - 2], Kind::kGarbage);
}

TEST(GrblWords, MoveSaysAllItReliesOn) {
  EXPECT_EQ(grblMove('A', -12.34567, 1200.0), "G21G90G94G53G1A-12.3457F1200.0");
  EXPECT_LE(grblMove('X', -1e9, 1e6).size(), 80U);  // GRBL's longest line
}

TEST(GrblWords, NumbersHaveNames) {
  EXPECT_THAT(grblErrorText(9), HasSubstr("locked"));
  EXPECT_EQ(grblErrorText(77), "error 77");
  EXPECT_THAT(grblAlarmText(1), HasSubstr("limit switch"));
  EXPECT_EQ(grblAxisIndex('A'), 3U);
}

}  // namespace
}  // namespace gyre
