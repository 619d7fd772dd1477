// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/watched_turntable.h"

#include <chrono>
#include <cmath>
#include <stop_token>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using Code = Error::Code;

constexpr double kNear_rad = radFromDeg(3.0);

// A person with a table: turns it as told, in his own way, and a camera that sees the markers'
// angle within one turn.
class WatchedTurntableTest : public testing::Test {
 protected:
  std::unique_ptr<WatchedTurntable> open() {
    auto table = WatchedTurntable::open(
        [this](const Task& task) -> Result<std::optional<double>> {
          if (task.stopRequested()) return cancelled();
          if (trouble_) return *trouble_;
          if (!visible_) return std::optional<double>();
          return std::optional(std::remainder(stands_rad_, kTurn_rad));
        },
        [this](const FreeTurn& turn) {
          told_.push_back(turn);
          if (!turn.seen) visible_ = true;  // the hand is taken away
          if (turn.seen) stands_rad_ += share_ * radFromDeg(turn.by_deg);
        },
        kNear_rad, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return table ? *std::move(table) : nullptr;
  }

  double stands_rad_ = 3.0;  // the markers' own count
  double share_ = 0.95;      // of what is asked for
  bool visible_ = true;
  std::optional<Error> trouble_;
  std::vector<FreeTurn> told_;
};

TEST_F(WatchedTurntableTest, StandsWhereItIsSeenThroughSeveralTurns) {
  const auto table = open();
  ASSERT_TRUE(table);
  EXPECT_EQ(table->angleRad(), 0.0);
  for (int view = 1; view <= 90; ++view) {
    ASSERT_TRUE(table->moveTo(radFromDeg(10.0 * view), Task()));
    EXPECT_NEAR(table->angleRad(), radFromDeg(10.0 * view), kNear_rad);
    EXPECT_NEAR(table->angleRad(), stands_rad_ - 3.0, 1e-9);
    EXPECT_NEAR(static_cast<double>(table->steps()), degFromRad(table->angleRad()) * 100.0, 0.501);
  }
}

TEST_F(WatchedTurntableTest, AsksAgainUntilItIsNearEnough) {
  const auto table = open();
  ASSERT_TRUE(table);
  share_ = 0.5;
  ASSERT_TRUE(table->moveTo(radFromDeg(20.0), Task()));
  ASSERT_EQ(told_.size(), 3U);  // 20, 10 and 5 degrees are left; then 2.5
  EXPECT_NEAR(told_[0].by_deg, 20.0, 1e-9);
  EXPECT_NEAR(told_[2].by_deg, 5.0, 1e-9);
  EXPECT_NEAR(told_[0].to_deg, 20.0, 1e-9);
  share_ = 1.0;
  ASSERT_TRUE(table->moveTo(0.0, Task()));
  EXPECT_LT(told_.back().by_deg, 0.0);
  ASSERT_TRUE(table->moveTo(kNear_rad * 0.9, Task()));  // near enough already
  EXPECT_EQ(told_.size(), 4U);
}

TEST_F(WatchedTurntableTest, SaysWhenItCannotBeSeenAndWaits) {
  const auto table = open();
  ASSERT_TRUE(table);
  visible_ = false;
  ASSERT_TRUE(table->moveTo(radFromDeg(20.0), Task()));
  ASSERT_EQ(told_.size(), 2U);
  EXPECT_FALSE(told_.front().seen);
}

TEST_F(WatchedTurntableTest, KeepsPlacesWhenTheAngleIsSetAnew) {
  const auto table = open();
  ASSERT_TRUE(table);
  ASSERT_TRUE(table->moveTo(radFromDeg(20.0), Task()));
  const TablePlace place = table->place();
  ASSERT_TRUE(table->setAngle(1.0));
  EXPECT_NEAR(table->angleRad(), 1.0, 1e-12);
  EXPECT_NEAR(*table->angleAt(place), 1.0, radFromDeg(0.01));
  EXPECT_TRUE(table->correct(-2.0));
  EXPECT_NEAR(table->angleRad(), 1.0, 1e-12);
  EXPECT_EQ(table->info().direction, 1);
}

TEST_F(WatchedTurntableTest, NamesWhatGoesWrong) {
  const auto table = open();
  ASSERT_TRUE(table);
  EXPECT_EQ(table->moveTo(std::nan(""), Task()).error().code, Code::kInvalidInput);
  EXPECT_EQ(table->setAngle(INFINITY).error().code, Code::kInvalidInput);
  EXPECT_EQ(table->correct(std::nan("")).error().code, Code::kInvalidInput);
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(table->moveTo(1.0, Task(source.get_token())).error().code, Code::kCancelled);
  trouble_ = Error{Code::kGone, "The camera is gone.", ""};
  EXPECT_EQ(table->moveTo(1.0, Task()).error().code, Code::kGone);
}

TEST_F(WatchedTurntableTest, DoesNotOpenWhenItIsNotSeen) {
  const auto table = WatchedTurntable::open(
      [](const Task&) -> Result<std::optional<double>> { return std::optional<double>(); },
      [](const FreeTurn&) {}, kNear_rad, Task());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, Code::kNotFound);
  EXPECT_THAT(table.error().advice, HasSubstr("markers"));
}

TEST_F(WatchedTurntableTest, StopEndsTheWaiting) {
  const auto table = open();
  ASSERT_TRUE(table);
  share_ = 0.0;  // nobody turns it
  std::stop_source source;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  EXPECT_EQ(table->moveTo(1.0, Task(source.get_token())).error().code, Code::kCancelled);
  EXPECT_EQ(told_.size(), 1U);
}

}  // namespace
}  // namespace gyre
