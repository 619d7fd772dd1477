// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_turning.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/device/protocol_turntable.h"
#include "core/sim/rig.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"
#include "tests/support/watched_target.h"

namespace gyre {
namespace {

using test::BlankCamera;
using test::OddTable;
using test::wedge;
using test::World;
using testing::HasSubstr;

constexpr double kMostMove_rad = radFromDeg(20.0);
// A lens that is not known may be off by so much in the angle.
constexpr double kRoughLens = 0.05;

Result<FoundTurning> findOn(OddTable& table, World& world, const Task& task = {}) {
  world.angle_rad = [&] { return table.trueAngleRad(); };
  BlankCamera camera;
  const Target target = wedge();
  return TurningFinder(table, camera, target, [&](const cv::Mat&) { return world.look(); })
      .find({}, task);
}

class FindTurningRatio : public testing::TestWithParam<double> {};

TEST_P(FindTurningRatio, IsFoundWithoutALargeMove) {
  OddTable table([](double told_rad) { return GetParam() * told_rad; });
  World world;
  const auto found = findOn(table, world);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->turned_over_told / GetParam(), 1.0, kRoughLens);
  EXPECT_LT(found->sigma, 0.01);
  EXPECT_LE(world.largest_move_rad, kMostMove_rad);
  EXPECT_LT(std::abs(found->turned_rad), radFromDeg(45.0));
  EXPECT_EQ(found->play_rad, 0.0);
}
INSTANTIATE_TEST_SUITE_P(FromAFiftiethToFifty, FindTurningRatio,
                         testing::Values(0.02, -0.02, 0.1, 0.5, -1.0, 1.0, 2.0, 7.0, -28.0, 50.0,
                                         -50.0));

TEST(FindTurning, LeavesATableAloneThatDoesAsItIsTold) {
  OddTable table([](double told_rad) { return 1.01 * told_rad; });
  World world;
  const auto found = findOn(table, world);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turned_over_told, 1.0);
  EXPECT_TRUE(found->remarks.empty());
}

TEST(FindTurning, SaysThatTheMotorDoesNotTurn) {
  OddTable table([](double) { return 0.0; });
  World world;
  const auto found = findOn(table, world);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, HasSubstr("stand still"));
  EXPECT_THAT(found.error().advice, HasSubstr("power"));
  EXPECT_TRUE(table.stopped);
}

TEST(FindTurning, TellsPlayInTheGears) {
  const double play_rad = radFromDeg(1.5);
  OddTable table([&](double told_rad) { return std::max(0.0, told_rad - play_rad); });
  World world;
  const auto found = findOn(table, world);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->turned_over_told, 1.0);
  EXPECT_NEAR(found->play_rad, play_rad, radFromDeg(0.3));  // the lens: a few percent of the way
  EXPECT_THAT(found->remarks, testing::Contains(HasSubstr("play")));
}

// The table hangs behind by up to the play when it is turned back; told and play in radians of the
// motor's word.
std::function<double(double)> withPlay(double ratio, double play_told_rad) {
  auto followed_rad = std::make_shared<double>(0.0);
  return [=](double told_rad) {
    *followed_rad = std::clamp(*followed_rad, told_rad, told_rad + play_told_rad);
    return ratio * *followed_rad;
  };
}

struct Play {
  double ratio = 1.0;
  double table_deg = 0.0;  // of the table
};

class FindTurningBacklash : public testing::TestWithParam<Play> {};

TEST_P(FindTurningBacklash, IsMeasuredByGoingBack) {
  const double play_rad = radFromDeg(GetParam().table_deg);
  OddTable table(withPlay(GetParam().ratio, play_rad / std::abs(GetParam().ratio)));
  World world;
  const auto found = findOn(table, world);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->turned_over_told / GetParam().ratio, 1.0, kRoughLens);
  // The lens makes a few percent of it; the rest is noise, and told.
  EXPECT_NEAR(found->backlash_rad, play_rad,
              kRoughLens * play_rad + 4.0 * found->backlash_sigma_rad);
  EXPECT_GT(found->backlash_sigma_rad, 0.0);
  EXPECT_LT(found->backlash_sigma_rad, radFromDeg(0.05));
  EXPECT_LE(world.largest_move_rad, kMostMove_rad);
  EXPECT_THAT(found->remarks, testing::Contains(HasSubstr("reached from the same side")));
}
INSTANTIATE_TEST_SUITE_P(OfAllSizes, FindTurningBacklash,
                         testing::Values(Play{1.0, 0.2}, Play{1.0, 1.0}, Play{1.0, 4.0},
                                         Play{-1.0, 0.5}, Play{-28.0, 2.0}, Play{0.1, 3.0}));

TEST(FindTurning, TellsNoBacklashOfNoise) {
  for (const double play_deg : {0.0, 0.02}) {
    OddTable table(withPlay(1.0, radFromDeg(play_deg)));
    World world;
    const auto found = findOn(table, world);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->backlash_rad, 0.0);
    EXPECT_TRUE(found->remarks.empty());
  }
}

TEST(FindTurning, SaysThatThereIsMorePlayThanItCanMeasure) {
  OddTable table(withPlay(1.0, radFromDeg(7.5)));
  World world;
  const auto found = findOn(table, world);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->backlash_rad, 0.0);
  EXPECT_THAT(found->remarks, testing::Contains(HasSubstr("Tighten")));
}

TEST(FindTurning, RefusesATargetThatSlips) {
  // Every other degree it stays behind.
  OddTable table([](double told_rad) {
    const double told_deg = degFromRad(told_rad);
    return radFromDeg(told_deg < 9.0 ? told_deg : 9.0 + 0.3 * (told_deg - 9.0));
  });
  World world;
  const auto found = findOn(table, world);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, HasSubstr("unevenly"));
}

TEST(FindTurning, GivesTheFindersReasonWhenTheTargetIsNotSeen) {
  OddTable table([](double told_rad) { return told_rad; });
  World world;
  world.visible = false;
  const auto found = findOn(table, world);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, HasSubstr("not in the picture"));
  EXPECT_EQ(world.pictures, 3);  // it was tried again
  EXPECT_EQ(table.angleRad(), 0.0);
}

TEST(FindTurning, StopsOnRequest) {
  OddTable table([](double told_rad) { return told_rad; });
  World world;
  std::stop_source source;
  source.request_stop();
  const auto found = findOn(table, world, Task(source.get_token()));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kCancelled);
  EXPECT_TRUE(table.stopped);
}

// Over the wire: the firmware believes in other steps than the motor has.
struct Wire {
  double believed_over_true = 1.0;
  bool inverted = false;
  Faults faults = {};
};

void expectCorrected(const Wire& wire) {
  const RigSettings rig;
  const auto shaft = std::make_shared<Shaft>();
  TurntableFirmwareOptions board;
  board.steps_per_turn = rig.steps_per_turn * wire.believed_over_true;
  TurntableFirmware firmware(board, shaft, SimClock(100.0));
  auto port = std::make_unique<FaultyPort>(firmware.openPort(), wire.faults);
  auto table = ProtocolTurntable::open(std::move(port), {}, {});
  ASSERT_TRUE(table) << table.error().sentence();
  World world;
  const double sign = wire.inverted ? -1.0 : 1.0;
  world.angle_rad = [&] { return sign * trueAngleRad(rig, shaft->steps()); };
  BlankCamera camera;
  const Target target = wedge();
  const auto found = TurningFinder(**table, camera, target, [&](const cv::Mat&) {
                       return world.look();
                     }).find({}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->turned_over_told / (sign * wire.believed_over_true), 1.0, kRoughLens);
  EXPECT_LE(world.largest_move_rad, kMostMove_rad);

  // From now on a quarter turn told is a quarter turn turned, counter-clockwise.
  const double before_rad = world.angle_rad();
  ASSERT_TRUE((*table)->correct(found->turned_over_told));
  EXPECT_EQ((*table)->angleRad(), 0.0);
  ASSERT_TRUE((*table)->moveTo(0.25 * kTurn_rad, {}));
  EXPECT_NEAR(world.angle_rad() - before_rad, 0.25 * kTurn_rad, kRoughLens * 0.25 * kTurn_rad);
  EXPECT_NEAR((*table)->info().units_per_turn, 360.0 / wire.believed_over_true,
              kRoughLens * 360.0 / wire.believed_over_true);
  EXPECT_EQ((*table)->info().direction, wire.inverted ? -1 : 1);
}

TEST(FindTurningOverTheWire, CorrectsTwiceTheSteps) { expectCorrected({2.0}); }
TEST(FindTurningOverTheWire, CorrectsAReversedMotor) { expectCorrected({1.0, true}); }
TEST(FindTurningOverTheWire, CorrectsFiftyTimesTheSteps) { expectCorrected({50.0, true}); }
TEST(FindTurningOverTheWire, CorrectsAFiftiethOfTheSteps) { expectCorrected({0.02}); }
TEST(FindTurningOverTheWire, CorrectsThroughASlowWire) {
  Wire wire{2.0, true};
  wire.faults.split = true;
  wire.faults.delay_s = 0.005;
  expectCorrected(wire);
}

}  // namespace
}  // namespace gyre
