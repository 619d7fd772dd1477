// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/turn_steps.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr double kFocal_px = 1400.0;

// A camera that looks down on the axis from a distance.
Rigid3 cameraAt(double distance_mm, double elevation_deg) {
  const double elevation = radFromDeg(elevation_deg);
  Rigid3 cam_from_table;
  const Eigen::Vector3d forward(-std::cos(elevation), 0.0, -std::sin(elevation));
  const Eigen::Vector3d right(0.0, 1.0, 0.0);
  cam_from_table.rotation.row(0) = right;
  cam_from_table.rotation.row(1) = forward.cross(right);
  cam_from_table.rotation.row(2) = forward;
  cam_from_table.translation = cam_from_table.rotation * (distance_mm * forward);
  return cam_from_table;
}

struct World {
  Rigid3 cam_from_table = cameraAt(400.0, 25.0);
  double noise_px = 0.3;
  double wrong = 0.0;       // share of matches of anything with anything
  double radius_mm = 40.0;  // of the object
  std::size_t spots = 200;

  TurnStepsOptions options() const {
    TurnStepsOptions options;
    options.tolerance = 1.0 / kFocal_px;
    options.most_radius_mm = 1.5 * radius_mm;
    return options;
  }

  std::vector<ViewMatch> matches(double from_rad, double to_rad, Random& random) const {
    std::vector<ViewMatch> found;
    while (found.size() < spots) {
      const Eigen::Vector3d spot(random.uniform(-radius_mm, radius_mm),
                                 random.uniform(-radius_mm, radius_mm),
                                 random.uniform(0.0, 2.0 * radius_mm));
      if (spot.head<2>().norm() > radius_mm) continue;
      ViewMatch match{seen(spot, from_rad, random), seen(spot, to_rad, random)};
      if (random.uniform() < wrong) {
        match.second = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
      }
      found.push_back(match);
    }
    return found;
  }

 private:
  Eigen::Vector2d seen(const Eigen::Vector3d& spot, double angle_rad, Random& random) const {
    const Eigen::Vector3d in_cam = camFromTable(cam_from_table, angle_rad) * spot;
    const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
    return in_cam.hnormalized() + noise_px / kFocal_px * noise;
  }
};

TurnMatches turned(const World& world, const std::vector<double>& angles_rad,
                   std::size_t stride = 1) {
  Random random(1);
  TurnMatches turn;
  turn.stride = stride;
  for (std::size_t i = 1; i < angles_rad.size(); ++i) {
    turn.pairs.push_back(world.matches(angles_rad[i - 1], angles_rad[i], random));
    if (i < stride) continue;
    const auto wide = world.matches(angles_rad[i - stride], angles_rad[i], random);
    turn.wide.insert(turn.wide.end(), wide.begin(), wide.end());
  }
  return turn;
}

std::vector<ViewMatch> closingOf(const World& world, const std::vector<double>& angles_rad) {
  Random random(2);
  return world.matches(angles_rad.back(), angles_rad.front(), random);
}

std::vector<double> evenly(int views, double step_deg) {
  std::vector<double> angles_rad(static_cast<std::size_t>(views));
  for (int i = 0; i < views; ++i) {
    angles_rad[static_cast<std::size_t>(i)] = radFromDeg(step_deg * i);
  }
  return angles_rad;
}

TEST(TurnSteps, AreExactWithoutNoise) {
  World world;
  world.noise_px = 0.0;
  for (const double step_deg : {10.0, -7.5, 1.8, -0.9}) {
    const TurnMatches turn = turned(world, evenly(12, step_deg), std::abs(step_deg) < 5.0 ? 8 : 1);
    const auto steps = turnSteps(turn, world.cam_from_table, world.options());
    ASSERT_TRUE(steps) << steps.error().sentence();
    for (const double step_rad : steps->steps_rad) {
      EXPECT_NEAR(degFromRad(step_rad), step_deg, 0.01);
    }
    EXPECT_FALSE(steps->closed);
  }
}

// A pixel is 0.3 mm here, 0.4 degrees of a spot 40 mm from the axis: 200 of them, 0.3 px each.
TEST(TurnSteps, AndTheirDirectionAreFoundUnderNoiseAndWrongMatches) {
  World world;
  world.wrong = 0.4;
  for (const double step_deg : {10.0, -10.0, 5.0, -20.0}) {
    const TurnMatches turn = turned(world, evenly(10, step_deg));
    const auto steps = turnSteps(turn, world.cam_from_table, world.options());
    ASSERT_TRUE(steps) << steps.error().sentence();
    EXPECT_NEAR(degFromRad(steps->common_rad), step_deg, 0.02 * std::abs(step_deg));
    EXPECT_GT(steps->agreeing, 9U * 200U / 2U);
  }
}

TEST(TurnSteps, OfAnUnevenMotorAreFoundEachByItself) {
  World world;
  std::vector<double> angles_rad = evenly(12, 10.0);
  Random random(4);
  for (double& angle_rad : angles_rad) angle_rad += radFromDeg(0.5) * random.gaussian();
  const TurnMatches turn = turned(world, angles_rad);
  const auto steps = turnSteps(turn, world.cam_from_table, world.options());
  ASSERT_TRUE(steps);
  double squares = 0.0;
  for (std::size_t i = 0; i < steps->steps_rad.size(); ++i) {
    squares += std::pow(degFromRad(steps->steps_rad[i] - (angles_rad[i + 1] - angles_rad[i])), 2);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(steps->steps_rad.size())), 0.3);
  EXPECT_GT(degFromRad(steps->scatter_rad), 0.2);
}

TEST(TurnSteps, MakeWholeTurnsWhenTheEndsMeet) {
  const World world;
  TurnMatches turn = turned(world, evenly(36, -10.0));
  turn.closing = closingOf(world, evenly(36, -10.0));
  const auto steps = turnSteps(turn, world.cam_from_table, world.options());
  ASSERT_TRUE(steps);
  EXPECT_TRUE(steps->closed);
  double turned_rad = 0.0;
  for (const double step_rad : steps->steps_rad) turned_rad += step_rad;
  EXPECT_NEAR(degFromRad(turned_rad), -350.0, 0.3);
}

// Seen from 20 m through a long lens, straight from the side, a larger step of a flatter object
// looks the same; which way it turns is seen by what little perspective there is.
TEST(TurnSteps, OfAWholeTurnAreFoundWhereSizeIsAmbiguous) {
  World world;
  world.cam_from_table = cameraAt(4000.0, 2.0);
  world.noise_px = 0.02;
  const TurnMatches turn = turned(world, evenly(36, 10.0));
  TurnStepsOptions options = world.options();
  options.tolerance = 0.1 / kFocal_px;
  const auto steps = turnSteps(turn, world.cam_from_table, options);
  ASSERT_TRUE(steps) << steps.error().sentence();
  EXPECT_NEAR(degFromRad(steps->common_rad), 10.0, 0.2);
}

TEST(TurnSteps, AreNoneWhereThePicturesDoNotTell) {
  const World world;
  EXPECT_FALSE(turnSteps({}, world.cam_from_table, world.options()));
  World noise;
  noise.wrong = 1.0;
  const TurnMatches turn = turned(noise, evenly(10, 10.0));
  const auto steps = turnSteps(turn, world.cam_from_table, world.options());
  ASSERT_FALSE(steps);
  EXPECT_EQ(steps.error().code, Error::Code::kTooFew);
  EXPECT_NE(steps.error().sentence().find("--step-deg"), std::string::npos);
}

}  // namespace
}  // namespace gyre
