// Bad wires: whatever happens, moveTo() ends in time, with a name for it, and the table stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"

namespace gyre {
namespace {

using Code = Error::Code;

// No move of these tests takes more than 2 s of real time; the rest is what deadlines may add.
constexpr double kLongest_s = 20.0;

class FaultsTest : public testing::TestWithParam<int> {
 protected:
  std::unique_ptr<ProtocolTurntable> openClean() {
    auto port = std::make_unique<FaultyPort>(firmware_.openPort(), Faults{});
    port_ = port.get();
    auto table = ProtocolTurntable::open(std::move(port), {}, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return *std::move(table);
  }
  bool stands() const {
    const std::int64_t before = shaft_->steps();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return shaft_->steps() == before;
  }
  // Walks through views; true when all arrived. Any error must leave the table at rest.
  bool walk(ProtocolTurntable& table, int views) {
    for (int view = 1; view <= views; ++view) {
      const double begin_s = steadySeconds();
      const Result<void> moved = table.moveTo(view * radFromDeg(10.0), Task());
      EXPECT_LT(steadySeconds() - begin_s, kLongest_s);
      if (!moved) {
        EXPECT_FALSE(moved.error().what.empty());
        EXPECT_NE(moved.error().code, Code::kInternal);
        EXPECT_TRUE(stands()) << moved.error().sentence();
        return false;
      }
      EXPECT_EQ(shaft_->steps(), std::llround(view * 3200.0 / 36.0));
      EXPECT_EQ(table.steps(), shaft_->steps());
    }
    return true;
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  TurntableFirmware firmware_{TurntableFirmwareOptions{}, shaft_, SimClock(20.0)};
  FaultyPort* port_ = nullptr;  // owned by the table
};

TEST_F(FaultsTest, SplitAndLateBytesDoNoHarm) {
  const auto table = openClean();
  port_->setFaults({.delay_s = 0.01, .split = true});
  EXPECT_TRUE(walk(*table, 4));
}

TEST_F(FaultsTest, OpensOverASplittingAndDelayingWire) {
  auto table = ProtocolTurntable::open(
      std::make_unique<FaultyPort>(firmware_.openPort(), Faults{.delay_s = 0.005, .split = true}),
      {}, Task());
  ASSERT_TRUE(table) << table.error().sentence();
  EXPECT_EQ((*table)->info().steps_per_turn, 3200.0);
}

TEST_F(FaultsTest, AfterASoftLimitTheBoardIsHeardAgain) {
  const std::string_view settings = "$20=1\n$130=30\n";
  {
    const auto terminal = firmware_.openPort();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_TRUE(terminal->write(std::as_bytes(std::span(settings)), 1.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const auto table = openClean();
  const Result<void> moved = table->moveTo(radFromDeg(90.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kAlarm);
  EXPECT_EQ(moved.error().sentence().find("may still be turning"), std::string::npos);
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_TRUE(table->release());
}

TEST_P(FaultsTest, FewBytesLostNeverLoseAnAngle) {
  const auto table = openClean();
  port_->setFaults({.seed = static_cast<std::uint64_t>(GetParam()), .drop = 0.002});
  walk(*table, 4);
}

TEST_P(FaultsTest, FewBytesSpoiltNeverLoseAnAngle) {
  const auto table = openClean();
  port_->setFaults({.seed = static_cast<std::uint64_t>(GetParam()), .corrupt = 0.002});
  walk(*table, 4);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FaultsTest, testing::Range(1, 5));

TEST_F(FaultsTest, VanishingPortIsGoneWhenever) {
  for (const std::int64_t bytes : {0, 1, 30, 60, 90}) {
    const auto table = openClean();
    port_->setFaults({.vanish_after_bytes = bytes + 1000000});
    ASSERT_TRUE(table->moveTo(radFromDeg(1.0), Task()));
    std::jthread puller([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(bytes));
      port_->vanish();
    });
    const Result<void> moved = table->moveTo(radFromDeg(80.0), Task());
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().code, Code::kGone);
  }
}

TEST_F(FaultsTest, DeadWireTimesOut) {
  const auto table = openClean();
  port_->setFaults({.drop = 1.0});
  const double begin_s = steadySeconds();
  const Result<void> moved = table->moveTo(radFromDeg(10.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kTimeout);
  EXPECT_LT(steadySeconds() - begin_s, 6.0);
  EXPECT_EQ(shaft_->steps(), 0);
}

TEST_P(FaultsTest, NothingMovesAfterAStop) {
  const auto table = openClean();
  port_->setFaults({.seed = static_cast<std::uint64_t>(GetParam()), .drop = 0.05});
  std::stop_source source;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(40 * GetParam()));
    source.request_stop();
  });
  const Result<void> moved = table->moveTo(radFromDeg(350.0), Task(source.get_token()));
  ASSERT_FALSE(moved);
  EXPECT_TRUE(stands()) << moved.error().sentence();
}

}  // namespace
}  // namespace gyre
