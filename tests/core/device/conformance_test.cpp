// Every driver against its own firmware, on good wires and on bad ones: always a named end before
// its deadline, never a wrong angle that is called right, never motion after a stop.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <stop_token>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/device/find_table.h"
#include "core/device/protocol_turntable.h"
#include "core/device/protocols/described_driver.h"
#include "core/io/turntable_file.h"
#include "core/sim/firmware_boards.h"
#include "core/sim/line_board.h"
#include "tests/support/faulty_port.h"
#include "tests/support/stepped_wire.h"

namespace gyre {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;
using Code = Error::Code;

// By the simulated clock: three tries of a bite that is awaited, halted and asked after, or a board
// that says for two minutes that it is busy.
constexpr double kLongest_s = 180.0;

std::unique_ptr<TableDriver> driverFor(const std::string& firmware,
                                       std::unique_ptr<BytePort> port) {
  if (firmware != "workshop") return makeTableDriver(firmware, std::move(port));
  auto description = readTurntableDescription(GYRE_TURNTABLES "/workshop.json");
  EXPECT_TRUE(description) << description.error().sentence();
  return std::make_unique<DescribedDriver>(std::move(port), *std::move(description));
}

class ConformanceTest : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<ProtocolTurntable> open(const std::string& name = "the wire") {
    auto port = std::make_unique<FaultyPort>(room_.openPort(name), Faults{});
    port_ = port.get();
    auto table = ProtocolTurntable::open(driverFor(GetParam(), std::move(port)), {}, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return table ? *std::move(table) : nullptr;
  }
  double stepsPerTurn() const {
    if (GetParam() == "artivact") return 12288.0;
    return GetParam() == "comxim" ? 14400.0 : 3200.0;
  }
  std::int64_t shaftAt(double angle_deg) const {
    return std::llround(angle_deg / 360.0 * stepsPerTurn());
  }
  bool saysNothingOfRestarts() const {
    return GetParam() == "fabscan" || GetParam() == "artivact" || GetParam() == "comxim";
  }
  // Whether the shaft rests for longer than any bite takes.
  bool stands() {
    const std::int64_t before = shaft_->steps();
    room_.pass(3.0);
    return shaft_->steps() == before;
  }
  Result<void> move(ProtocolTurntable& table, double angle_deg) {
    const double begin_s = room_.seconds();
    Result<void> moved = table.moveTo(radFromDeg(angle_deg), Task());
    EXPECT_LT(room_.seconds() - begin_s, kLongest_s);
    return moved;
  }
  // Goes round; whatever fails has a name and leaves a table at rest. True when all arrived.
  bool walk(ProtocolTurntable& table, int views) {
    for (int view = 1; view <= views; ++view) {
      const Result<void> moved = move(table, 7.0 * view);
      if (!moved) {
        EXPECT_FALSE(moved.error().what.empty());
        EXPECT_NE(moved.error().code, Code::kInternal);
        EXPECT_NE(moved.error().code, Code::kCancelled);
        EXPECT_TRUE(stands()) << moved.error().sentence();
        return false;
      }
      EXPECT_NEAR(static_cast<double>(shaft_->steps()),
                  degFromRad(table.angleRad()) / 360.0 * stepsPerTurn(), 0.501);
      EXPECT_NEAR(degFromRad(table.angleRad()), 7.0 * view, 0.06);
      EXPECT_FALSE(room_.board().busy());
    }
    return true;
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  test::SteppedRoom room_{makeFirmwareBoard(GetParam(), TurntableFirmwareOptions{}, shaft_)};
  FaultyPort* port_ = nullptr;  // owned by the table
};

TEST_P(ConformanceTest, OpensWithoutMoving) {
  const auto table = open();
  ASSERT_TRUE(table);
  EXPECT_FALSE(table->info().firmware.empty());
  EXPECT_GT(table->info().steps_per_turn, 0.0);
  EXPECT_EQ(table->angleRad(), 0.0);
  room_.pass(3.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_P(ConformanceTest, ComesBackOnlyWhenTheTableStandsAtItsAngle) {
  const auto table = open();
  ASSERT_TRUE(table);
  for (const double angle_deg : {45.0, 46.0, 180.0, 90.0, -30.0}) {
    const Result<void> moved = move(*table, angle_deg);
    ASSERT_TRUE(moved) << moved.error().sentence();
    EXPECT_EQ(shaft_->steps(), shaftAt(angle_deg));
    EXPECT_FALSE(room_.board().busy());
  }
  EXPECT_TRUE(stands());
}

TEST_P(ConformanceTest, CarriesTheRemainderThroughAWholeTurn) {
  const auto table = open();
  ASSERT_TRUE(table);
  for (int view = 1; view <= 72; ++view) {
    const Result<void> moved = move(*table, 5.0 * view);
    ASSERT_TRUE(moved) << moved.error().sentence();
    ASSERT_EQ(shaft_->steps(), shaftAt(5.0 * view));
  }
  EXPECT_EQ(shaft_->steps(), std::llround(stepsPerTurn()));
}

TEST_P(ConformanceTest, StopSlowsDownAndKeepsTheAngle) {
  for (const double after_s : {0.0, 0.004, 0.01, 0.02, 0.03, 0.04, 0.05, 0.1, 0.4, 0.55, 1.3}) {
    const auto table = open();
    ASSERT_TRUE(table);
    ASSERT_TRUE(move(*table, 1.0));
    const std::int64_t begin = shaft_->steps();
    room_.at(room_.seconds() + after_s, [&] { table->stop(); });
    const double begin_s = room_.seconds();
    const Result<void> moved = move(*table, 300.0);
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().code, Code::kCancelled);
    EXPECT_LT(room_.seconds() - begin_s, after_s + 3.0);
    EXPECT_TRUE(stands());
    EXPECT_NEAR(static_cast<double>(shaft_->steps() - begin),
                (degFromRad(table->angleRad()) - 1.0) / 360.0 * stepsPerTurn(), 1.001);
    const std::int64_t at_zero = begin - shaftAt(1.0);
    const Result<void> again = move(*table, 40.0);
    ASSERT_TRUE(again) << again.error().sentence();
    EXPECT_EQ(shaft_->steps(), at_zero + shaftAt(40.0));
  }
}

TEST_P(ConformanceTest, StopRequestOfTheTaskEndsItToo) {
  const auto table = open();
  ASSERT_TRUE(table);
  std::stop_source source;
  room_.at(room_.seconds() + 0.7, [&] { source.request_stop(); });
  const Result<void> moved = table->moveTo(radFromDeg(300.0), Task(source.get_token()));
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kCancelled);
  EXPECT_TRUE(stands());
}

TEST_P(ConformanceTest, DeadWireTimesOut) {
  const auto table = open();
  ASSERT_TRUE(table);
  port_->setFaults({.drop = 1.0});
  const Result<void> moved = move(*table, 10.0);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kTimeout);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_P(ConformanceTest, AnswerCutInHalfIsNoArrival) {
  for (std::int64_t bytes = 0; bytes < 80; bytes += 5) {
    const auto table = open();
    ASSERT_TRUE(table);
    port_->setFaults({.mute_after_bytes = bytes});
    const Result<void> moved = move(*table, 10.0);
    EXPECT_TRUE(stands());
    if (!moved) {
      EXPECT_THAT(moved.error().code, AnyOf(Eq(Code::kTimeout), Eq(Code::kAlarm)));
    }
  }
}

TEST_P(ConformanceTest, SplitAndLateBytesDoNoHarm) {
  const auto table = open();
  ASSERT_TRUE(table);
  port_->setFaults({.delay_s = 0.01, .split = true});
  EXPECT_TRUE(walk(*table, 5));
}

TEST_P(ConformanceTest, NoiseNeverMakesAWrongAngleRight) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto table = open();
    ASSERT_TRUE(table);
    const std::int64_t begin = shaft_->steps();
    port_->setFaults({.seed = seed, .corrupt = 0.003, .noise = 0.003, .host_is_heard_well = true});
    for (int view = 1; view <= 6; ++view) {
      const Result<void> moved = move(*table, 7.0 * view);
      if (!moved) {
        EXPECT_NE(moved.error().code, Code::kInternal);
        EXPECT_TRUE(stands()) << moved.error().sentence();
        break;
      }
      EXPECT_NEAR(static_cast<double>(shaft_->steps() - begin), 7.0 / 360 * view * stepsPerTurn(),
                  0.51 * stepsPerTurn() / 3200.0 + 0.5);
    }
  }
}

TEST_P(ConformanceTest, LostBytesEndInAName) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto table = open();
    ASSERT_TRUE(table);
    port_->setFaults({.seed = seed, .drop = 0.01});
    for (int view = 1; view <= 6; ++view) {
      const Result<void> moved = move(*table, 7.0 * view);
      if (moved) continue;
      EXPECT_NE(moved.error().code, Code::kInternal);
      EXPECT_FALSE(moved.error().what.empty());
      EXPECT_TRUE(stands()) << moved.error().sentence();
      break;
    }
  }
}

TEST_P(ConformanceTest, RestartInMidMoveLosesTheAngle) {
  const auto table = open();
  ASSERT_TRUE(table);
  room_.at(room_.seconds() + 1.0, [&] { room_.board().reset(room_.seconds()); });
  const Result<void> moved = move(*table, 300.0);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, saysNothingOfRestarts() ? Code::kTimeout : Code::kAlarm);
  EXPECT_TRUE(stands());
  EXPECT_EQ(move(*table, 10.0).error().code, Code::kAlarm);
  const std::int64_t before = shaft_->steps();
  ASSERT_TRUE(table->setAngle(0.0));
  const Result<void> again = move(*table, 45.0);
  ASSERT_TRUE(again) << again.error().sentence();
  EXPECT_EQ(shaft_->steps(), before + shaftAt(45.0));
}

TEST_P(ConformanceTest, RestartBetweenMovesIsNoticedWhereItIsTold) {
  if (saysNothingOfRestarts()) GTEST_SKIP() << "This firmware says nothing when it starts.";
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 45.0));
  const std::int64_t before = shaft_->steps();
  room_.board().reset(room_.seconds());
  room_.pass(2.0);
  const Result<void> moved = move(*table, 90.0);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_EQ(shaft_->steps(), before);
}

TEST_P(ConformanceTest, AlarmIsNamed) {
  const std::string& firmware = GetParam();
  if (firmware != "horus" && firmware != "marlin") GTEST_SKIP() << "It has none, or needs $21.";
  const auto table = open();
  ASSERT_TRUE(table);
  room_.at(room_.seconds() + 1.0, [&] { room_.board().pressLimitSwitch(room_.seconds()); });
  const Result<void> moved = move(*table, 300.0);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_TRUE(stands());
  EXPECT_EQ(move(*table, 10.0).error().code, Code::kAlarm);
}

TEST_P(ConformanceTest, BoardThatIsBusyForAMinute) {
  auto* board = dynamic_cast<LineBoard*>(&room_.board());
  if (board == nullptr) GTEST_SKIP() << "GRBL does nothing else.";
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 5.0));
  // While a bite is under way, so that it is already obeyed.
  room_.at(room_.seconds() + 0.6, [&] { board->occupy(60.0, room_.seconds()); });
  const Result<void> moved = move(*table, 100.0);
  const bool says_so = GetParam() == "marlin" || GetParam() == "workshop";
  if (says_so) {
    ASSERT_TRUE(moved) << moved.error().sentence();
    EXPECT_EQ(shaft_->steps(), shaftAt(100.0));
    return;
  }
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kTimeout);
  // It may obey the line that it has not read yet: that is said.
  EXPECT_THAT(moved.error().what, HasSubstr("may still be turning"));
  EXPECT_EQ(move(*table, 10.0).error().code, Code::kAlarm);
}

TEST_P(ConformanceTest, PulledCableIsGoneAndComesBackUnderAnotherName) {
  for (const double after_s : {0.01, 0.5, 2.0}) {
    auto table = open("/dev/ttyACM0");
    ASSERT_TRUE(table);
    room_.at(room_.seconds() + after_s, [&] { room_.pullCable(); });
    const Result<void> moved = move(*table, 300.0);
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().code, Code::kGone);
    EXPECT_EQ(move(*table, 10.0).error().code, Code::kGone);
    EXPECT_FALSE(table->setAngle(0.0));
    EXPECT_FALSE(table->release());
    room_.pass(20.0);
    const std::int64_t before = shaft_->steps();
    table = open("/dev/ttyACM1");
    ASSERT_TRUE(table);
    EXPECT_EQ(table->info().device_id, "/dev/ttyACM1");
    EXPECT_EQ(shaft_->steps(), before);
    ASSERT_TRUE(move(*table, 9.0));
    EXPECT_EQ(shaft_->steps(), before + shaftAt(9.0));
  }
}

TEST_P(ConformanceTest, ReleaseLetsGoOrSaysThatItCannot) {
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 9.0));
  const Result<void> released = table->release();
  if (!released) {
    EXPECT_EQ(released.error().code, Code::kRejected);
    EXPECT_THAT(released.error().what, HasSubstr("cannot switch its motor off"));
    EXPECT_TRUE(move(*table, 18.0));
    return;
  }
  EXPECT_EQ(move(*table, 18.0).error().code, Code::kAlarm);
  ASSERT_TRUE(table->setAngle(0.0));
  const std::int64_t before = shaft_->steps();
  if (!table->info().lock.empty()) {
    EXPECT_EQ(move(*table, 18.0).error().code, Code::kNoPermission);
    table->allowUnlock();
  }
  const Result<void> moved = move(*table, 18.0);
  ASSERT_TRUE(moved) << moved.error().sentence();
  EXPECT_EQ(shaft_->steps(), before + shaftAt(18.0));
}

TEST_P(ConformanceTest, CorrectedTableTurnsByWhatItIsTold) {
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(move(*table, 30.0));
  const std::int64_t before = shaft_->steps();
  ASSERT_TRUE(table->correct(-0.5));  // it turned half as far, the other way
  const Result<void> moved = move(*table, 45.0);
  ASSERT_TRUE(moved) << moved.error().sentence();
  EXPECT_EQ(shaft_->steps() - before, -shaftAt(90.0));
  ASSERT_TRUE(move(*table, 0.0));
  EXPECT_EQ(shaft_->steps(), before);
}

INSTANTIATE_TEST_SUITE_P(Firmwares, ConformanceTest, testing::ValuesIn(firmwareBoardNames()),
                         [](const auto& firmware) { return firmware.param; });

}  // namespace
}  // namespace gyre
