// What is never sent unasked, byte for byte: nothing that homes, heats, cuts, unlocks or writes a
// setting, whatever happens, by any driver; and nothing that moves before a move is asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/device/find_table.h"
#include "core/device/protocol_turntable.h"
#include "core/device/protocols/described_driver.h"
#include "core/io/turntable_file.h"
#include "core/sim/firmware_boards.h"
#include "tests/support/faulty_port.h"
#include "tests/support/stepped_wire.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Code = Error::Code;

std::unique_ptr<TableDriver> driverFor(const std::string& firmware,
                                       std::unique_ptr<BytePort> port) {
  if (firmware != "workshop") return makeTableDriver(firmware, std::move(port));
  auto description = readTurntableDescription(GYRE_TURNTABLES "/workshop.json");
  EXPECT_TRUE(description) << description.error().sentence();
  return std::make_unique<DescribedDriver>(std::move(port), *std::move(description));
}

class HarmlessTest : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<ProtocolTurntable> open() {
    auto port = std::make_unique<FaultyPort>(room_.openPort("the wire"), Faults{});
    port_ = port.get();
    auto table = ProtocolTurntable::open(driverFor(GetParam(), std::move(port)), {}, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return table ? *std::move(table) : nullptr;
  }
  static Result<void> move(ProtocolTurntable& table, double angle_deg) {
    return table.moveTo(radFromDeg(angle_deg), Task());
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  test::SteppedRoom room_{makeFirmwareBoard(GetParam(), TurntableFirmwareOptions{}, shaft_)};
  FaultyPort* port_ = nullptr;  // owned by the table
};

// What would home, heat, cut, unlock or change a setting, in any of the languages.
void expectHarmless(const std::string& sent) {
  for (const char* word :
       {"$H",     "$X",   "$N",   "$RST", "$C",      "G10",    "G28",       "G30",  "G38",
        "M3",     "M4 ",  "M104", "M109", "M140",    "M190",   "M500",      "M501", "M502",
        "M211 S", "M92 ", "M203", "T C",  "SETZERO", "TOZERO", "SETSPEED=", "SAVE", "EEPROM"}) {
    EXPECT_THAT(sent, Not(HasSubstr(word)));
  }
  EXPECT_EQ(sent.find('='), std::string::npos) << sent;  // no $110=3600, no setting of any kind
}

TEST_P(HarmlessTest, SendsNothingThatHomesHeatsUnlocksOrWritesASetting) {
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 40.0));
  ASSERT_TRUE(move(*table, 10.0));
  (void)table->release();
  (void)table->setAngle(0.0);
  (void)move(*table, 10.0);
  expectHarmless(room_.sent());
}

TEST_P(HarmlessTest, NorDoesItAfterAnAlarmAStopARestartOrOnABadWire) {
  const auto table = open();
  ASSERT_TRUE(table);
  room_.at(room_.seconds() + 0.5, [&] { room_.board().pressLimitSwitch(room_.seconds()); });
  room_.at(room_.seconds() + 4.0, [&] { table->stop(); });
  (void)move(*table, 120.0);
  (void)table->setAngle(0.0);
  (void)move(*table, 10.0);
  room_.board().reset(room_.seconds());
  room_.pass(2.0);
  (void)move(*table, 20.0);
  (void)table->setAngle(0.0);
  (void)move(*table, 20.0);
  port_->setFaults({.seed = 3, .corrupt = 0.01, .host_is_heard_well = true});
  for (int i = 0; i < 3; ++i) (void)move(*table, 5.0 * i);
  expectHarmless(room_.sent());
}

TEST_P(HarmlessTest, ConnectingAndAskingMovesNothing) {
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(table->setAngle(0.3));
  ASSERT_TRUE(table->correct(-2.0));
  (void)table->info();
  table->stop();
  for (const char* word : {"G0", "G1", "$J", "M17", "M18", "T R", "T A", "MOVE", "TRUNSINGLE",
                           "START", "TURN", "G2", "G6", "\nON\n"}) {
    EXPECT_THAT(room_.sent(), Not(HasSubstr(word)));
  }
  expectHarmless(room_.sent());
  room_.pass(3.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

INSTANTIATE_TEST_SUITE_P(Firmwares, HarmlessTest, testing::ValuesIn(firmwareBoardNames()),
                         [](const auto& firmware) { return firmware.param; });

// The one firmware that locks itself, set up so that it does at every start.
class LockedBoardTest : public testing::Test {
 protected:
  std::unique_ptr<ProtocolTurntable> open(bool may_unlock = false) {
    TurntableOptions options;
    options.may_unlock = may_unlock;
    auto table = ProtocolTurntable::open(room_.openPort("the wire"), options, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    opened_at_ = room_.sent().size();
    return table ? *std::move(table) : nullptr;
  }
  static TurntableFirmwareOptions homingOn() {
    TurntableFirmwareOptions options;
    options.homing = true;
    return options;
  }
  // Since the table was opened.
  std::string sent() const { return room_.sent().substr(opened_at_); }
  static Result<void> move(ProtocolTurntable& table, double angle_deg) {
    return table.moveTo(radFromDeg(angle_deg), Task());
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  test::SteppedRoom room_{makeFirmwareBoard("grbl", homingOn(), shaft_)};
  std::size_t opened_at_ = 0;
};

TEST_F(LockedBoardTest, StaysLockedUntilAPersonAllowsItsUnlocking) {
  const auto table = open();
  ASSERT_TRUE(table);
  EXPECT_THAT(table->info().lock, HasSubstr("is locked"));
  EXPECT_THAT(table->info().lock, HasSubstr("homing is on"));
  for (const double angle_deg : {9.0, 18.0}) {
    const Result<void> refused = move(*table, angle_deg);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Code::kNoPermission);
    EXPECT_THAT(refused.error().advice, HasSubstr("--unlock"));
  }
  EXPECT_EQ(sent().find_first_not_of('?'), std::string::npos) << sent();  // asked how it is
  EXPECT_EQ(shaft_->steps(), 0);
  table->allowUnlock();
  EXPECT_THAT(table->info().lock, IsEmpty());
  ASSERT_TRUE(move(*table, 9.0));
  EXPECT_THAT(sent(), HasSubstr("$X\n"));
  EXPECT_EQ(shaft_->steps(), 80);
}

TEST_F(LockedBoardTest, TheWordHoldsForOneOpening) {
  auto table = open(true);
  ASSERT_TRUE(table);
  EXPECT_THAT(table->info().lock, IsEmpty());
  ASSERT_TRUE(move(*table, 9.0));
  table = open();
  ASSERT_TRUE(table);
  EXPECT_EQ(move(*table, 9.0).error().code, Code::kNoPermission);
  EXPECT_EQ(shaft_->steps(), 80);
}

TEST_F(LockedBoardTest, AnAlarmVoidsTheWord) {
  const auto terminal = room_.openPort("a terminal");
  room_.pass(1.0);
  const std::string limits_on = "$21=1\n";
  ASSERT_TRUE(terminal->write(std::as_bytes(std::span(limits_on)), 1.0));
  room_.pass(1.0);
  const auto table = open(true);
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 9.0));
  room_.at(room_.seconds() + 1.0, [&] { room_.board().pressLimitSwitch(room_.seconds()); });
  EXPECT_EQ(move(*table, 180.0).error().code, Code::kAlarm);
  ASSERT_TRUE(table->setAngle(0.0));
  const std::int64_t before = shaft_->steps();
  EXPECT_EQ(move(*table, 10.0).error().code, Code::kNoPermission);
  EXPECT_THAT(table->info().lock, HasSubstr("has stopped by itself"));
  EXPECT_EQ(shaft_->steps(), before);
}

TEST_F(LockedBoardTest, SendsNothingHarmfulWhileItWaitsForTheWord) {
  const auto table = open();
  ASSERT_TRUE(table);
  for (const double angle_deg : {10.0, 0.0, 90.0}) (void)move(*table, angle_deg);
  (void)table->release();
  (void)table->setAngle(0.0);
  EXPECT_EQ(move(*table, 30.0).error().code, Code::kNoPermission);
  expectHarmless(room_.sent());
  EXPECT_THAT(sent(), Not(HasSubstr("G1")));
  EXPECT_EQ(shaft_->steps(), 0);
}

}  // namespace
}  // namespace gyre
