// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/hand_turntable.h"

#include <cmath>
#include <stop_token>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"

namespace gyre {
namespace {

using Code = Error::Code;

struct Person {
  std::vector<HandTurn> asked;
  Result<void> answer;
  AskPerson asking() {
    return [this](const HandTurn& turn, const Task&) {
      asked.push_back(turn);
      return answer;
    };
  }
};

std::unique_ptr<HandTurntable> tableWith(Person& person, double ticks) {
  TurntableOptions options;
  options.steps_per_turn = ticks;
  return *HandTurntable::open(options, person.asking());
}

TEST(HandTurntable, AsksForWholeMarksAndBelievesThePerson) {
  Person person;
  const auto table = tableWith(person, 24.0);
  EXPECT_EQ(table->info().steps_per_turn, 24.0);
  ASSERT_TRUE(table->moveTo(radFromDeg(46.0), Task()));
  ASSERT_EQ(person.asked.size(), 1U);
  EXPECT_EQ(person.asked[0].ticks, 3);
  EXPECT_DOUBLE_EQ(person.asked[0].to_deg, 45.0);
  EXPECT_DOUBLE_EQ(person.asked[0].tick_deg, 15.0);
  EXPECT_EQ(table->steps(), 3);
  EXPECT_NEAR(table->angleRad(), radFromDeg(45.0), 1e-12);
}

TEST(HandTurntable, LessThanHalfAMarkIsNoMove) {
  Person person;
  const auto table = tableWith(person, 24.0);
  ASSERT_TRUE(table->moveTo(radFromDeg(-3.0), Task()));
  EXPECT_TRUE(person.asked.empty());
}

TEST(HandTurntable, AWholeTurnComesBackToTheFirstMark) {
  Person person;
  const auto table = tableWith(person, 8.0);
  for (int view = 1; view <= 8; ++view) {
    ASSERT_TRUE(table->moveTo(view * kTurn_rad / 8.0, Task()));
  }
  EXPECT_EQ(person.asked.size(), 8U);
  EXPECT_DOUBLE_EQ(person.asked.back().to_deg, 0.0);
  EXPECT_EQ(table->steps(), 8);
}

TEST(HandTurntable, PersonWhoGivesUpLeavesTheAngleAsItWas) {
  Person person;
  person.answer = cancelled();
  const auto table = tableWith(person, 24.0);
  EXPECT_EQ(table->moveTo(1.0, Task()).error().code, Code::kCancelled);
  EXPECT_EQ(table->steps(), 0);
}

TEST(HandTurntable, StoppedTaskAsksNobody) {
  Person person;
  const auto table = tableWith(person, 24.0);
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(table->moveTo(1.0, Task(source.get_token())).error().code, Code::kCancelled);
  EXPECT_TRUE(person.asked.empty());
}

TEST(HandTurntable, PlacesAndAnglesAreCountedAnewTogether) {
  Person person;
  const auto table = tableWith(person, 36.0);
  ASSERT_TRUE(table->moveTo(radFromDeg(50.0), Task()));
  const TablePlace place = table->place();
  ASSERT_TRUE(table->setAngle(0.0));
  EXPECT_NEAR(table->angleAt(place).value(), 0.0, 1e-12);
  ASSERT_TRUE(table->moveTo(radFromDeg(20.0), Task()));
  EXPECT_DOUBLE_EQ(person.asked.back().to_deg, 20.0);
  EXPECT_NEAR(table->angleAt(place).value(), 0.0, 1e-12);
}

TEST(HandTurntable, MarksAreNotCorrected) {
  Person person;
  const auto table = tableWith(person, 36.0);
  EXPECT_TRUE(table->correct(1.0));
  EXPECT_EQ(table->correct(-1.0).error().code, Code::kRejected);
}

TEST(HandTurntable, WithoutAPersonThereIsNoTable) {
  EXPECT_EQ(HandTurntable::open({}, nullptr).error().code, Code::kInvalidInput);
  Person person;
  const auto table = tableWith(person, 36.0);
  EXPECT_EQ(table->moveTo(std::nan(""), Task()).error().code, Code::kInvalidInput);
  EXPECT_EQ(table->setAngle(INFINITY).error().code, Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
