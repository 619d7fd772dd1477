// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_turning.h"

#include <cmath>
#include <functional>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/device/protocol_turntable.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/rig.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr double kMostMove_rad = radFromDeg(20.0);
constexpr double kSighting_sigma_px = 0.05;
// A lens that is not known may be off by so much in the angle.
constexpr double kRoughLens = 0.05;

// Two faces of lattice points, at right angles, standing on the table.
Target wedge() {
  Target target;
  target.name = "wedge";
  for (int face = 0; face < 2; ++face) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double along = 10.0 * (column - 1.5);
        const double up = 8.0 + 10.0 * row;
        target.corners.push_back(
            {static_cast<int>(target.corners.size()),
             face == 0 ? Eigen::Vector3d(20.0, along, up) : Eigen::Vector3d(along, 20.0, up)});
      }
    }
  }
  return target;
}

// What stands on the platter, seen exactly but for noise; nothing is rendered.
class World {
 public:
  // The truth of the table's angle, wherever it comes from. [rad]
  std::function<double()> angle_rad;
  bool visible = true;
  int pictures = 0;
  double largest_move_rad = 0.0;

  Result<TargetView> look() {
    const double now_rad = angle_rad();
    if (pictures++ > 0) {
      largest_move_rad = std::max(largest_move_rad, std::abs(now_rad - last_rad_));
    }
    last_rad_ = now_rad;
    if (!visible)
      return Error{Error::Code::kNotFound, "The target is not in the picture.", "Look."};
    const Calibration truth = trueCalibration({});
    Rigid3 table_from_target;
    table_from_target.translation = {6.0, -9.0, 0.0};
    TargetView view;
    Random random(static_cast<std::uint64_t>(pictures));
    const Target target = wedge();
    for (std::size_t i = 0; i < target.corners.size(); ++i) {
      const Eigen::Vector3d x = table_from_target * target.corners[i].position_in_target;
      const auto pixel = truth.camera.project(camFromTable(*truth.cam_from_table, now_rad) * x);
      const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
      view.sightings.push_back(
          {static_cast<int>(i), *pixel + kSighting_sigma_px * noise, kSighting_sigma_px});
    }
    return view;
  }

 private:
  double last_rad_ = 0.0;
};

// Pictures of the right size in which the finder does not look.
class BlankCamera final : public Camera {
 public:
  Result<FramePtr> grabAfter(double, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    Frame frame;
    frame.image_bgr = cv::Mat::zeros(960, 1280, CV_8UC3);
    return std::make_shared<const Frame>(frame);
  }
  Result<CameraInfo> lockControls() override { return CameraInfo{}; }
  CameraInfo info() const override { return {}; }
};

// A table that obeys at once, in its own way.
class OddTable final : public Turntable {
 public:
  explicit OddTable(std::function<double(double told_rad)> turned_rad)
      : turned_rad_(std::move(turned_rad)) {}

  Result<void> moveTo(double angle_rad, const Task&) override {
    told_rad_ = angle_rad;
    return {};
  }
  double angleRad() const override { return told_rad_; }
  double trueAngleRad() const { return turned_rad_(told_rad_); }
  std::int64_t steps() const override { return 0; }
  Result<void> setAngle(double) override { return {}; }
  void stop() noexcept override { stopped = true; }
  Result<void> release() override { return {}; }
  Result<void> correct(double) override { return {}; }
  TurntableInfo info() const override { return {}; }

  bool stopped = false;

 private:
  std::function<double(double)> turned_rad_;
  double told_rad_ = 0.0;
};

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
TEST(FindTurningOverTheWire, CorrectsThroughABadWire) {
  Wire wire{2.0, true};
  wire.faults.split = true;
  wire.faults.corrupt = 0.001;
  wire.faults.drop = 0.001;
  expectCorrected(wire);
}

}  // namespace
}  // namespace gyre
