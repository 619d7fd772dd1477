// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/rough_turntable.h"

#include <cmath>
#include <numbers>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

struct World {
  double focal_px = 1500.0;
  double elevation_deg = 25.0;
  double roll_deg = 0.0;
  double pan_deg = 2.0;
  double step_rad = radFromDeg(10.0);
  double noise_px = 0.3;
  double wrong = 0.15;  // share of matches of anything with anything

  // Distances are in units of the camera's distance from the axis, as in the result.
  Rigid3 camFromTable() const {
    const double c = std::cos(radFromDeg(elevation_deg));
    const double s = std::sin(radFromDeg(elevation_deg));
    Eigen::Matrix3d upright;
    upright << 0.0, 1.0, 0.0, s, 0.0, -c, -c, 0.0, -s;
    const Eigen::Matrix3d rotation =
        (Eigen::AngleAxisd(radFromDeg(roll_deg), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(radFromDeg(pan_deg), Eigen::Vector3d::UnitY()))
            .toRotationMatrix() *
        upright;
    return {rotation, -rotation.col(0)};
  }

  std::vector<TurnedMatch> matches(bool angles_known) const {
    Random random(3);
    std::vector<TurnedMatch> all;
    const Rigid3 pose = camFromTable();
    const double foot = -std::tan(radFromDeg(elevation_deg)) - 0.1;
    for (int view = 0; view < 36; ++view) {
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d spot(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                                   foot + random.uniform(0.0, 0.2));
        TurnedMatch match{seen(pose, spot, view * step_rad, random),
                          seen(pose, spot, (view + 1) * step_rad, random),
                          angles_known ? step_rad : 1.0};
        if (random.uniform() < wrong) {
          match.second_px = {random.uniform(0.0, 1279.0), random.uniform(0.0, 959.0)};
        }
        all.push_back(match);
      }
    }
    return all;
  }

  RoughTurntableOptions options(bool angles_known) const {
    RoughTurntableOptions options;
    options.width_px = 1280;
    options.height_px = 960;
    options.angles_known = angles_known;
    options.step_rad = 2.0 * std::numbers::pi / 36.0;
    return options;
  }

 private:
  Eigen::Vector2d seen(const Rigid3& pose, const Eigen::Vector3d& spot, double angle_rad,
                       Random& random) const {
    const Eigen::Vector3d in_cam = gyre::camFromTable(pose, angle_rad) * spot;
    return focal_px * in_cam.hnormalized() + Eigen::Vector2d(639.5, 479.5) +
           noise_px * Eigen::Vector2d(random.gaussian(), random.gaussian());
  }
};

double turnBetween(const Rigid3& a, const Rigid3& b) {
  return degFromRad(
      Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation * b.rotation.transpose())).angle());
}

TEST(RoughTurntable, IsExactWithoutNoise) {
  World world;
  world.noise_px = 0.0;
  world.wrong = 0.0;
  const auto found = roughTurntable(world.matches(false), world.options(false), {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->calibration.camera.fx, 1500.0, 1.0);
  EXPECT_NEAR(degFromRad(found->step_rad), 10.0, 1e-3);
  EXPECT_LT(turnBetween(*found->calibration.cam_from_table, world.camFromTable()), 0.02);
  EXPECT_EQ(found->agreeing, 36U * 60U);
}

TEST(RoughTurntable, BearsNoiseAndWrongMatches) {
  for (const double elevation_deg : {-15.0, 10.0, 50.0}) {
    World world;
    world.elevation_deg = elevation_deg;
    const auto found = roughTurntable(world.matches(false), world.options(false), {});
    ASSERT_TRUE(found) << elevation_deg << ": " << found.error().sentence();
    EXPECT_NEAR(found->calibration.camera.fx / 1500.0, 1.0, 0.05) << elevation_deg;
    EXPECT_LT(turnBetween(*found->calibration.cam_from_table, world.camFromTable()), 1.5);
    EXPECT_NEAR(degFromRad(found->step_rad), 10.0, 1e-9);
  }
}

TEST(RoughTurntable, TellsATableThatTurnsTheOtherWay) {
  World world;
  world.step_rad = radFromDeg(-10.0);
  const auto found = roughTurntable(world.matches(false), world.options(false), {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(degFromRad(found->step_rad), -10.0, 1e-9);
  EXPECT_LT(turnBetween(*found->calibration.cam_from_table, world.camFromTable()), 1.5);
}

TEST(RoughTurntable, BelievesAnglesThatAreTold) {
  for (const double roll_deg : {0.0, 90.0, 180.0}) {
    World world;
    world.roll_deg = roll_deg;
    const auto found = roughTurntable(world.matches(true), world.options(true), {});
    ASSERT_TRUE(found) << found.error().sentence();
    EXPECT_NEAR(found->calibration.camera.fx / 1500.0, 1.0, 0.05);
    EXPECT_LT(turnBetween(*found->calibration.cam_from_table, world.camFromTable()), 1.5)
        << roll_deg;
    EXPECT_EQ(found->step_rad, 1.0);
  }
}

TEST(TurnedCalibration, TurnsACameraThatWasNudged) {
  const World world;
  Calibration truth;
  truth.camera = {1280, 960, 1500.0, 1500.0, 0.0, 639.5, 479.5};
  // The same camera in another frame: at another azimuth, height and distance.
  const Eigen::AngleAxisd azimuth(0.7, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d centre = azimuth * Eigen::Vector3d(400.0, 0.0, 150.0);
  const Eigen::Matrix3d rotation =
      world.camFromTable().rotation * azimuth.toRotationMatrix().transpose();
  truth.cam_from_table = Rigid3{rotation, -(rotation * centre)};
  Calibration nudged = truth;
  const Eigen::AngleAxisd off(radFromDeg(3.0), Eigen::Vector3d(0.5, 1.0, -0.7).normalized());
  nudged.cam_from_table->rotation = off.toRotationMatrix() * rotation;
  nudged.cam_from_table->translation = -(nudged.cam_from_table->rotation * centre);
  const auto turned = turnedCalibration(world.matches(true), nudged, 1.0, {});
  ASSERT_TRUE(turned) << turned.error().sentence();
  EXPECT_LT(turnBetween(*turned->cam_from_table, *truth.cam_from_table), 0.15);
  EXPECT_LT((turned->cam_from_table->inverse().translation - centre).norm(), 1e-9);
}

TEST(RoughTurntable, RefusesMatchesOfNothing) {
  World world;
  world.wrong = 1.0;
  const auto found = roughTurntable(world.matches(false), world.options(false), {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kTooFew);
}

TEST(RoughTurntable, RefusesFewMatches) {
  const World world;
  auto few = world.matches(false);
  few.resize(49);
  const auto found = roughTurntable(few, world.options(false), {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kTooFew);
}

TEST(RoughTurntable, StopsWhenAsked) {
  const World world;
  std::stop_source stop;
  stop.request_stop();
  const auto found =
      roughTurntable(world.matches(false), world.options(false), Task(stop.get_token()));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
