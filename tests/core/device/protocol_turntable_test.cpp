// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocol_turntable.h"

#include <array>
#include <chrono>
#include <cmath>
#include <stop_token>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/sim/pipe_port.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Code = Error::Code;

void sleepMilliseconds(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// Writes down what is sent.
class RecordingPort final : public BytePort {
 public:
  RecordingPort(std::unique_ptr<BytePort> port, std::string& sent)
      : port_(std::move(port)), sent_(sent) {}
  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override {
    return port_->read(buffer, timeout_s);
  }
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override {
    for (const std::byte byte : bytes) sent_ += static_cast<char>(byte);
    return port_->write(bytes, timeout_s);
  }
  std::string name() const override { return port_->name(); }

 private:
  std::unique_ptr<BytePort> port_;
  std::string& sent_;
};

// A table 20 times as fast as a real one.
class ProtocolTurntableTest : public testing::Test {
 protected:
  std::unique_ptr<ProtocolTurntable> open(const Faults& faults = {},
                                          const TurntableOptions& options = {}) {
    auto port = std::make_unique<FaultyPort>(firmware_.openPort(), faults);
    port_ = port.get();
    auto table = ProtocolTurntable::open(std::move(port), options, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return table ? *std::move(table) : nullptr;
  }
  // Settings are sent by a terminal of our own, as a user would.
  void configure(std::string_view lines) {
    const auto port = firmware_.openPort();
    sleepMilliseconds(50);
    ASSERT_TRUE(port->write(std::as_bytes(std::span(lines)), 1.0));
    sleepMilliseconds(50);
  }
  // Whether the shaft stands still for two simulated seconds.
  bool stands() const {
    const std::int64_t before = shaft_->steps();
    sleepMilliseconds(100);
    return shaft_->steps() == before;
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  TurntableFirmware firmware_{TurntableFirmwareOptions{}, shaft_, SimClock(20.0)};
  FaultyPort* port_ = nullptr;  // owned by the table
};

TEST_F(ProtocolTurntableTest, IdentifiesTheBoardWithoutMovingIt) {
  const auto table = open();
  EXPECT_EQ(table->info().firmware, "Grbl 1.1h");
  EXPECT_EQ(table->info().steps_per_turn, 3200.0);  // though $100 says 3200.04
  EXPECT_THAT(table->info().hindrances, IsEmpty());
  EXPECT_EQ(table->angleRad(), 0.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(ProtocolTurntableTest, ArrivesWithTheShaftAtRest) {
  const auto table = open();
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft_->steps(), 400);
  EXPECT_EQ(table->steps(), 400);
  EXPECT_NEAR(table->angleRad(), radFromDeg(45.0), 1e-12);
  EXPECT_TRUE(stands());
}

TEST_F(ProtocolTurntableTest, CarriesTheRemainderOfAStep) {
  const auto table = open();
  for (int view = 1; view <= 72; ++view) {  // 44.44 steps each
    ASSERT_TRUE(table->moveTo(view * kTurn_rad / 72.0, Task()));
    ASSERT_EQ(shaft_->steps(), std::llround(view * 3200.0 / 72.0));
    ASSERT_EQ(table->steps(), shaft_->steps());
  }
  EXPECT_EQ(shaft_->steps(), 3200);
}

TEST_F(ProtocolTurntableTest, BackwardMovesPassTheirTargetAndReturn) {
  std::string sent;
  auto port = std::make_unique<RecordingPort>(firmware_.openPort(), sent);
  const auto table = ProtocolTurntable::open(std::move(port), {}, Task());
  ASSERT_TRUE(table) << table.error().sentence();
  ASSERT_TRUE((*table)->moveTo(radFromDeg(45.0), Task()));
  sent.clear();
  ASSERT_TRUE((*table)->moveTo(radFromDeg(22.5), Task()));
  EXPECT_EQ(shaft_->steps(), 200);
  // 182 steps, then 200, of 8.889 a degree.
  const std::size_t past = sent.find("G1X20.4747");
  ASSERT_NE(past, std::string::npos) << sent;
  EXPECT_NE(sent.find("G1X22.4997", past), std::string::npos) << sent;
}

TEST_F(ProtocolTurntableTest, LongerApproachTakesUpPlayThatIsKnown) {
  const auto loose = std::make_shared<Shaft>(30);  // 3.4 degrees: more than the usual 2
  TurntableFirmware firmware({}, loose, SimClock(20.0));
  auto table = ProtocolTurntable::open(firmware.openPort(), {}, Task());
  ASSERT_TRUE(table) << table.error().sentence();
  ASSERT_TRUE((*table)->moveTo(radFromDeg(45.0), Task()));
  ASSERT_TRUE((*table)->moveTo(radFromDeg(22.5), Task()));
  EXPECT_EQ(loose->steps(), 200);
  EXPECT_EQ(loose->tableSteps(), 212);  // not followed: 18 of 30 steps were taken up
  (*table)->setApproach(radFromDeg(4.0));
  EXPECT_NEAR((*table)->approachRad(), radFromDeg(4.0), 1e-12);
  ASSERT_TRUE((*table)->correct(-1.0));  // what is known of play stays
  EXPECT_NEAR((*table)->approachRad(), radFromDeg(4.0), 1e-12);
  ASSERT_TRUE((*table)->correct(-1.0));
  ASSERT_TRUE((*table)->moveTo(radFromDeg(45.0), Task()));
  ASSERT_TRUE((*table)->moveTo(radFromDeg(22.5), Task()));
  EXPECT_EQ(loose->tableSteps(), loose->steps());
  (*table)->setApproach(-1.0);
  EXPECT_EQ((*table)->approachRad(), 0.0);
  (*table)->setApproach(10.0);
  EXPECT_NEAR((*table)->approachRad(), radFromDeg(45.0), 1e-12);
}

TEST_F(ProtocolTurntableTest, DirectionTurnsTheOtherWay) {
  TurntableOptions options;
  options.direction = -1;
  const auto table = open({}, options);
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft_->steps(), -400);
  EXPECT_EQ(table->steps(), 400);
  ASSERT_TRUE(table->moveTo(0.0, Task()));
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_F(ProtocolTurntableTest, SetAngleMovesNothing) {
  const auto table = open();
  ASSERT_TRUE(table->setAngle(radFromDeg(90.0)));
  EXPECT_EQ(table->steps(), 800);
  EXPECT_EQ(shaft_->steps(), 0);
  ASSERT_TRUE(table->moveTo(radFromDeg(135.0), Task()));
  EXPECT_EQ(shaft_->steps(), 400);
}

TEST_F(ProtocolTurntableTest, PlaceHoldsHoweverAnglesAreCounted) {
  const auto table = open();
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  const TablePlace place = table->place();
  ASSERT_TRUE(table->moveTo(radFromDeg(90.0), Task()));
  EXPECT_NEAR(table->angleAt(place).value(), radFromDeg(45.0), 1e-9);
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_NEAR(table->angleAt(place).value(), radFromDeg(-45.0), 1e-9);
  // One radian told was half of one turned, the other way.
  ASSERT_TRUE(table->correct(-0.5));
  EXPECT_NEAR(table->angleAt(place).value(), radFromDeg(22.5), 1e-9);
  EXPECT_NEAR(table->angleAt(table->place()).value(), 0.0, 1e-9);
}

TEST_F(ProtocolTurntableTest, PlaceIsLostWithTheAngle) {
  const auto table = open();
  ASSERT_TRUE(table->moveTo(radFromDeg(30.0), Task()));
  const TablePlace place = table->place();
  ASSERT_TRUE(table->release());
  EXPECT_FALSE(table->angleAt(place));
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_FALSE(table->angleAt(place));
  EXPECT_EQ(table->angleAt(table->place()).value(), 0.0);
}

TEST_F(ProtocolTurntableTest, StopFromAnotherThreadSlowsDownAndKeepsThePosition) {
  const auto table = open();
  std::jthread stopper([&] {
    sleepMilliseconds(100);
    table->stop();
  });
  const Result<void> moved = table->moveTo(radFromDeg(180.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kCancelled);
  EXPECT_TRUE(stands());
  EXPECT_GT(shaft_->steps(), 0);
  EXPECT_LT(shaft_->steps(), 1600);
  EXPECT_EQ(table->steps(), shaft_->steps());
  ASSERT_TRUE(table->moveTo(radFromDeg(180.0), Task()));
  EXPECT_EQ(shaft_->steps(), 1600);
}

TEST_F(ProtocolTurntableTest, StopRequestOfTheTaskDoesTheSame) {
  const auto table = open();
  std::stop_source source;
  std::jthread stopper([&] {
    sleepMilliseconds(100);
    source.request_stop();
  });
  const Result<void> moved = table->moveTo(radFromDeg(-180.0), Task(source.get_token()));
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kCancelled);
  EXPECT_TRUE(stands());
  EXPECT_EQ(table->steps(), shaft_->steps());
  const Result<void> again = table->moveTo(0.0, Task(source.get_token()));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Code::kCancelled);
}

TEST_F(ProtocolTurntableTest, ResetOfTheBoardLosesTheAngle) {
  const auto table = open();
  std::jthread presser([&] {
    sleepMilliseconds(100);
    firmware_.pressReset();
  });
  const Result<void> moved = table->moveTo(radFromDeg(180.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_TRUE(stands());
  const Result<void> again = table->moveTo(radFromDeg(10.0), Task());
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Code::kAlarm);
  EXPECT_TRUE(stands());
  const std::int64_t before = shaft_->steps();
  ASSERT_TRUE(table->setAngle(0.0));
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft_->steps(), before + 400);
}

TEST_F(ProtocolTurntableTest, ResetBetweenMovesIsNoticed) {
  const auto table = open();
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  firmware_.pressReset();
  sleepMilliseconds(60);
  const Result<void> moved = table->moveTo(radFromDeg(90.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_EQ(shaft_->steps(), 400);
}

TEST_F(ProtocolTurntableTest, LimitSwitchIsAnAlarm) {
  configure("$21=1\n");
  const auto table = open();
  EXPECT_THAT(table->info().hindrances, ElementsAre(HasSubstr("$21=0")));
  std::jthread presser([&] {
    sleepMilliseconds(100);
    firmware_.pressLimitSwitch();
  });
  const Result<void> moved = table->moveTo(radFromDeg(180.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_THAT(moved.error().what, HasSubstr("limit switch"));
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_EQ(table->moveTo(radFromDeg(10.0), Task()).error().code, Code::kNoPermission);
  EXPECT_THAT(table->info().lock, HasSubstr("has stopped by itself"));
  table->allowUnlock();
  EXPECT_TRUE(table->moveTo(radFromDeg(10.0), Task()));
}

TEST_F(ProtocolTurntableTest, HindrancesAreToldInWords) {
  configure("$1=25\n$20=1\n$22=1\n$100=8.9\n$110=600\n");
  const auto table = open();
  EXPECT_THAT(table->info().hindrances, ElementsAre(HasSubstr("$1=255"), HasSubstr("$20=0"),
                                                    HasSubstr("$22=0"), HasSubstr("10 deg/s")));
  EXPECT_EQ(table->info().steps_per_turn, 3204.0);
}

TEST_F(ProtocolTurntableTest, ReportsInWorkPositionsAndInchesAreUnderstood) {
  configure("$10=0\n$13=1\n");
  const auto table = open();
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft_->steps(), 400);
}

TEST_F(ProtocolTurntableTest, ReleaseLetsGoAndTheAngleMustBeSetAnew) {
  const auto table = open();
  ASSERT_TRUE(table->release());
  const Result<void> moved = table->moveTo(radFromDeg(9.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_EQ(table->moveTo(radFromDeg(9.0), Task()).error().code, Code::kNoPermission);
  EXPECT_THAT(table->info().lock, HasSubstr("its motor was let go of"));
  table->allowUnlock();
  ASSERT_TRUE(table->moveTo(radFromDeg(9.0), Task()));
  EXPECT_EQ(shaft_->steps(), 80);
}

TEST_F(ProtocolTurntableTest, WrongOptionsAreRefused) {
  TurntableOptions options;
  options.axis = "Q";
  auto table = ProtocolTurntable::open(firmware_.openPort(), options, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kInvalidInput);
  options = {};
  options.axis = "B";
  table = ProtocolTurntable::open(firmware_.openPort(), options, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kRejected);
}

TEST_F(ProtocolTurntableTest, AngleThatIsNoNumberIsRefused) {
  const auto table = open();
  EXPECT_EQ(table->moveTo(std::nan(""), Task()).error().code, Code::kInvalidInput);
  EXPECT_EQ(table->setAngle(INFINITY).error().code, Code::kInvalidInput);
}

TEST_F(ProtocolTurntableTest, MoreTurnsThanTheFirmwareCanCountAreRefused) {
  const auto table = open();
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_EQ(table->moveTo(1000.0 * kTurn_rad, Task()).error().code, Code::kRejected);
}

// Something that is no GRBL: silent, or answering everything with the same line.
class Stranger {
 public:
  explicit Stranger(std::string answer) : answer_(std::move(answer)) {
    auto [host, device] = PipePort::makePair("stranger");
    host_ = std::move(host);
    device_ = std::move(device);
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        std::array<std::byte, 64> buffer{};
        const Result<std::size_t> count = device_->read(buffer, 0.01);
        if (!count) return;
        heard_ += *count;
        if (*count == 0 || answer_.empty()) continue;
        if (!device_->write(std::as_bytes(std::span(answer_)), 0.1)) return;
      }
    });
  }
  std::unique_ptr<PipePort> takePort() { return std::move(host_); }

 private:
  std::string answer_;
  std::unique_ptr<PipePort> host_;
  std::unique_ptr<PipePort> device_;
  std::size_t heard_ = 0;
  std::jthread thread_;
};

TEST(ProtocolTurntableStrangers, SilenceEndsInATimeout) {
  Stranger stranger("");
  const double begin_s = steadySeconds();
  TurntableOptions impatient;
  impatient.greeting_s = 0.1;
  const auto table = ProtocolTurntable::open(stranger.takePort(), impatient, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kTimeout);
  EXPECT_LT(steadySeconds() - begin_s, 8.0);
}

TEST(ProtocolTurntableStrangers, ForeignFirmwareIsNamed) {
  Stranger stranger("echo:Marlin 2.1\n");
  TurntableOptions impatient;
  impatient.greeting_s = 0.1;
  const auto table = ProtocolTurntable::open(stranger.takePort(), impatient, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kWrongDevice);
  EXPECT_THAT(table.error().what, HasSubstr("Marlin"));
}

TEST(ProtocolTurntableStrangers, WaitingForAGreetingCanBeCancelled) {
  Stranger stranger("");
  std::stop_source source;
  std::jthread stopper([&] {
    sleepMilliseconds(50);
    source.request_stop();
  });
  const double begin_s = steadySeconds();
  const auto table = ProtocolTurntable::open(stranger.takePort(), {}, Task(source.get_token()));
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kCancelled);
  EXPECT_LT(steadySeconds() - begin_s, 0.5);
}

}  // namespace
}  // namespace gyre
