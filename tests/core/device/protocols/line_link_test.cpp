// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/line_link.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/device/protocols/bite_driver.h"
#include "core/sim/pipe_port.h"

namespace gyre {
namespace {

using testing::IsEmpty;
using testing::Optional;

class LineLinkTest : public testing::Test {
 protected:
  LineLink& open(const LineFraming& framing = {}) {
    auto [host, device] = PipePort::makePair("the pipe");
    device_ = std::move(device);
    link_.emplace(std::move(host), framing);
    return *link_;
  }
  void tell(std::string_view bytes) {
    EXPECT_TRUE(device_->write(std::as_bytes(std::span(bytes)), 1.0));
  }
  std::optional<std::string> next() {
    const auto line = link_->receive(0.02);
    EXPECT_TRUE(line);
    return line ? *line : std::nullopt;
  }

  std::unique_ptr<PipePort> device_;
  std::optional<LineLink> link_;
};

TEST_F(LineLinkTest, CutsLinesAndPassesOverEmptyOnes) {
  open();
  tell("\r\n  ok \r\n\r\nsecond\nthi");
  EXPECT_THAT(next(), Optional(std::string("ok")));
  EXPECT_THAT(next(), Optional(std::string("second")));
  EXPECT_EQ(next(), std::nullopt);
  tell("rd\r");
  EXPECT_THAT(next(), Optional(std::string("third")));
}

TEST_F(LineLinkTest, EndsAndPromptsAreTheFirmwares) {
  open({.send_end = "", .ends = ";", .prompt = '>'});
  tell(">CR+OK;a>b;");
  EXPECT_THAT(next(), Optional(std::string(">")));
  EXPECT_THAT(next(), Optional(std::string("CR+OK")));
  EXPECT_THAT(next(), Optional(std::string("a>b")));
}

TEST_F(LineLinkTest, NoiseWithoutAnEndIsCut) {
  open();
  tell(std::string(2000, '\x01') + "\nok\n");
  std::optional<std::string> last;
  for (auto line = next(); line; line = next()) last = line;
  EXPECT_THAT(last, Optional(std::string("ok")));
  EXPECT_LE(link_->heard().size(), 200U);
}

TEST_F(LineLinkTest, VanishedPortIsGone) {
  open();
  device_.reset();
  EXPECT_EQ(link_->receive(0.02).error().code, Error::Code::kGone);
  EXPECT_FALSE(link_->send("x"));
}

TEST(NumberAfter, ReadsTheLastOne) {
  EXPECT_EQ(numberAfter("REVOLUTION STEPS  => 4096", "=>"), 4096.0);
  EXPECT_EQ(numberAfter("a:1 a:-2.5", "a:"), -2.5);
  EXPECT_EQ(numberAfter("a: x", "a:"), std::nullopt);
  EXPECT_EQ(numberAfter("a:inf", "a:"), std::nullopt);
  EXPECT_EQ(numberAfter("a:", "a:"), std::nullopt);
  EXPECT_EQ(numberAfter("", "a:"), std::nullopt);
}

TEST(StepCountingMotor, OptionsKnowBetterThanTheFirmwareAndThatBetterThanCustom) {
  TurntableOptions options;
  EXPECT_EQ(stepCountingMotor("x", options, 4096.0, 3200.0).steps_per_turn, 4096.0);
  EXPECT_EQ(stepCountingMotor("x", options, std::nullopt, 3200.0).steps_per_turn, 3200.0);
  EXPECT_FALSE(stepCountingMotor("x", options, std::nullopt, 3200.0).hindrances.empty());
  options.steps_per_turn = 6400.0;
  EXPECT_EQ(stepCountingMotor("x", options, 4096.0, 3200.0).steps_per_turn, 6400.0);
  EXPECT_THAT(stepCountingMotor("x", options, std::nullopt, 3200.0).hindrances, IsEmpty());
  options = {};
  options.units_per_turn = 6397.5;  // as a calibration measured it
  options.turning_measured = true;
  EXPECT_EQ(stepCountingMotor("x", options, 4096.0, 3200.0).units_per_turn, 6397.5);
}

}  // namespace
}  // namespace gyre
