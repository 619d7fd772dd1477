// What one firmware has and the others have not; what all have in common is in conformance_test.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/device/protocols/described_driver.h"
#include "core/device/protocols/fabscan_driver.h"
#include "core/device/protocols/horus_driver.h"
#include "core/device/protocols/marlin_driver.h"
#include "core/device/protocols/sardauscan_driver.h"
#include "core/sim/fabscan_board.h"
#include "core/sim/horus_board.h"
#include "core/sim/marlin_board.h"
#include "core/sim/sardauscan_board.h"
#include "tests/support/stepped_wire.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Code = Error::Code;

template <class Driver>
std::unique_ptr<ProtocolTurntable> openTable(test::SteppedRoom& room,
                                             const TurntableOptions& options = {}) {
  auto table =
      ProtocolTurntable::open(std::make_unique<Driver>(room.openPort("the wire")), options, Task());
  EXPECT_TRUE(table) << table.error().sentence();
  return table ? *std::move(table) : nullptr;
}

TEST(MarlinDriver, ReadsStepsThatAreToldWithTwoDecimals) {
  const auto shaft = std::make_shared<Shaft>();
  test::SteppedRoom room(std::make_unique<MarlinBoard>(TurntableFirmwareOptions{}, shaft));
  const auto table = openTable<MarlinDriver>(room);
  EXPECT_EQ(table->info().firmware, "Marlin 2.1.2");
  EXPECT_EQ(table->info().steps_per_turn, 3200.0);
  EXPECT_THAT(table->info().hindrances, IsEmpty());
  // Five turns on, the motor's count still is ours.
  for (int turn = 1; turn <= 5; ++turn) {
    const Result<void> moved = table->moveTo(turn * kTurn_rad, Task());
    ASSERT_TRUE(moved) << moved.error().sentence();
    EXPECT_EQ(shaft->steps(), turn * 3200);
  }
}

TEST(MarlinDriver, SoftEndstopsAreAHindranceAndNoArrival) {
  const auto shaft = std::make_shared<Shaft>();
  test::SteppedRoom room(std::make_unique<MarlinBoard>(TurntableFirmwareOptions{}, shaft,
                                                       MarlinBoard::SoftEndstops::kOn));
  const auto table = openTable<MarlinDriver>(room);
  EXPECT_THAT(table->info().hindrances, ElementsAre(HasSubstr("M211 S0")));
  ASSERT_TRUE(table->moveTo(radFromDeg(200.0), Task()));
  const Result<void> moved = table->moveTo(radFromDeg(300.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kRejected);
  EXPECT_NEAR(degFromRad(table->angleRad()), 235.0, 0.1);
}

TEST(MarlinDriver, AxisThatTheBoardDoesNotTellNeedsItsSteps) {
  test::SteppedRoom room(
      std::make_unique<MarlinBoard>(TurntableFirmwareOptions{}, std::make_shared<Shaft>()));
  TurntableOptions options;
  options.axis = "A";
  const auto table = ProtocolTurntable::open(
      std::make_unique<MarlinDriver>(room.openPort("the wire")), options, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kRejected);
}

TEST(HorusDriver, ReadsItsSteps) {
  test::SteppedRoom room(std::make_unique<HorusBoard>(
      TurntableFirmwareOptions{.steps_per_turn = 6400.0}, std::make_shared<Shaft>()));
  const auto table = openTable<HorusDriver>(room);
  EXPECT_EQ(table->info().firmware, "Horus 0.2");
  EXPECT_EQ(table->info().steps_per_turn, 6400.0);
}

TEST(FabScanDriver, StepsAreAHindranceUntilTheyAreKnown) {
  const auto shaft = std::make_shared<Shaft>();
  test::SteppedRoom room(std::make_unique<FabScanBoard>(TurntableFirmwareOptions{}, shaft));
  auto table = openTable<FabScanDriver>(room);
  EXPECT_THAT(table->info().hindrances, ElementsAre(HasSubstr("3200")));
  EXPECT_EQ(table->info().units_per_turn, 3200.0);
  ASSERT_TRUE(table->correct(0.5));  // a kit with 6400
  EXPECT_EQ(table->info().units_per_turn, 6400.0);
  EXPECT_THAT(table->info().hindrances, IsEmpty());
  ASSERT_TRUE(table->moveTo(radFromDeg(90.0), Task()));
  EXPECT_EQ(shaft->steps(), 1600);
  TurntableOptions options;  // as a scan that is resumed says it
  options.units_per_turn = 6400.0;
  options.turning_measured = true;
  table = openTable<FabScanDriver>(room, options);
  EXPECT_EQ(table->info().steps_per_turn, 6400.0);
}

TEST(SardauscanDriver, TellsItsStepsAndNeverCountsBeyondWhatItsFirmwareCan) {
  const auto shaft = std::make_shared<Shaft>();
  test::SteppedRoom room(
      std::make_unique<SardauscanBoard>(TurntableFirmwareOptions{.steps_per_turn = 4096.0}, shaft));
  const auto table = openTable<SardauscanDriver>(room);
  EXPECT_EQ(table->info().steps_per_turn, 4096.0);
  EXPECT_THAT(table->info().hindrances, IsEmpty());
  ASSERT_TRUE(table->moveTo(10.0 * kTurn_rad, Task()));
  EXPECT_EQ(shaft->steps(), 40960);
}

// Answers each line as it is told to, and keeps the lines.
class ScriptedBoard final : public FirmwareBoard {
 public:
  using Answer = std::function<std::string(const std::string& line)>;
  explicit ScriptedBoard(std::vector<std::string>& lines, Answer answer)
      : lines_(lines), answer_(std::move(answer)) {}
  void reset(double) override {}
  void receive(std::span<const std::byte> bytes, double) override {
    for (const std::byte byte : bytes) {
      const char c = static_cast<char>(byte);
      if (c != '\n') {
        line_ += c;
        continue;
      }
      output_ += answer_(line_);
      lines_.push_back(std::exchange(line_, {}));
    }
  }
  void advanceTo(double) override {}
  void pressLimitSwitch(double) override {}
  std::string takeOutput() override { return std::exchange(output_, {}); }
  bool busy() const override { return false; }

 private:
  std::vector<std::string>& lines_;
  Answer answer_;
  std::string line_;
  std::string output_;
};

TEST(MarlinDriver, PrinterAtWorkIsLeftAlone) {
  std::vector<std::string> lines;
  int count = 0;
  test::SteppedRoom room(std::make_unique<ScriptedBoard>(lines, [&](const std::string& line) {
    if (line == "M115") return std::string("FIRMWARE_NAME:Marlin 2.1.2 (x)\r\nok\r\n");
    return "X:1.00 Y:0.00 Count X:" + std::to_string(++count) + " Y:0\r\nok\r\n";
  }));
  const auto table = ProtocolTurntable::open(
      std::make_unique<MarlinDriver>(room.openPort("the wire")), {}, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kBusy);
  EXPECT_THAT(lines, ElementsAre("M115", "M114", "M114"));
}

TEST(DescribedDriver, PlacesInDegreesAreToldInTheTablesOwnDirection) {
  std::vector<std::string> lines;
  test::SteppedRoom room(std::make_unique<ScriptedBoard>(lines, [](const std::string& line) {
    return line == "who" ? "a stage\r\n" : line.starts_with("goto") ? "there\r\n" : "what?\r\n";
  }));
  TurntableDescription stage;
  stage.name = "Stage";
  stage.ask = {"who", "a stage"};
  stage.unit = TurntableDescription::Unit::kDegrees;
  stage.units_per_turn = 360.0;
  stage.decimals = 2;
  stage.direction = -1;
  stage.move = "goto {to} at {speed}";
  stage.done = "there";
  stage.refused = "what?";
  auto table = ProtocolTurntable::open(
      std::make_unique<DescribedDriver>(room.openPort("the wire"), stage), {}, Task());
  ASSERT_TRUE(table) << table.error().sentence();
  EXPECT_EQ((*table)->info().steps_per_turn, 36000.0);
  ASSERT_TRUE((*table)->moveTo(radFromDeg(7.125), Task()));
  EXPECT_EQ(lines.back(), "goto -7.13 at 20");
  EXPECT_EQ((*table)->release().error().code, Code::kRejected);
}

TEST(DescribedDriver, AnotherTableIsToldFromIt) {
  std::vector<std::string> lines;
  test::SteppedRoom room(std::make_unique<ScriptedBoard>(
      lines, [](const std::string&) { return std::string("coffee\r\n"); }));
  TurntableDescription stage;
  stage.name = "Stage";
  stage.ask = {"who", "a stage"};
  stage.units_per_turn = 3200.0;
  stage.move = "turn {by}";
  stage.done = "there";
  const auto table = ProtocolTurntable::open(
      std::make_unique<DescribedDriver>(room.openPort("the wire"), stage), {}, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kWrongDevice);
  EXPECT_THAT(table.error().what, HasSubstr("coffee"));
}

}  // namespace
}  // namespace gyre
