// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/self_calibration.h"

#include <cmath>
#include <numbers>
#include <stop_token>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr int kViews = 24;

Calibration trueCalibration() {
  Calibration calibration;
  calibration.camera = {1280, 960, 1500.0, 1500.0, 0.0, 639.5, 479.5};
  calibration.camera.k1 = -0.08;
  const double c = std::cos(radFromDeg(30.0));
  const double s = std::sin(radFromDeg(30.0));
  Eigen::Matrix3d rotation;
  rotation << 0.0, 1.0, 0.0, s, 0.0, -c, -c, 0.0, -s;
  calibration.cam_from_table = Rigid3{rotation, {0.0, 30.0, 400.0}};
  return calibration;
}

struct Turn {
  std::vector<PixelTrack> tracks;
  ViewAngles angles;
};

// Points of a ball, each seen in a third of a turn; started where they are not quite.
Turn seenTurn(double noise_px, double wrong) {
  Random random(7);
  const Calibration truth = trueCalibration();
  Turn turn;
  for (int view = 0; view < kViews; ++view) {
    turn.angles.told_rad.push_back(2.0 * std::numbers::pi * view / kViews);
  }
  turn.angles.start_rad = turn.angles.told_rad;
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector3d side =
        Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
    const Eigen::Vector3d point = Eigen::Vector3d(0.0, 0.0, 40.0) + 35.0 * side;
    PixelTrack track;
    const int first = i % kViews;
    for (int k = 0; k < kViews / 3; ++k) {
      const int view = (first + k) % kViews;
      const double angle_rad = turn.angles.told_rad[static_cast<std::size_t>(view)];
      const auto pixel =
          truth.camera.project(camFromTable(*truth.cam_from_table, angle_rad) * point);
      Observation seen{view, *pixel, std::max(noise_px, 0.1)};
      seen.pixel += noise_px * Eigen::Vector2d(random.gaussian(), random.gaussian());
      if (random.uniform() < wrong) seen.pixel.x() += 20.0;
      track.observations.push_back(seen);
    }
    track.position_in_table =
        point + 0.3 * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
    turn.tracks.push_back(std::move(track));
  }
  return turn;
}

// The camera turned where it stands, with another lens.
Calibration wrongCalibration(double off_deg, double focal_share, double k1) {
  Calibration calibration = trueCalibration();
  const Eigen::Vector3d centre = calibration.cam_from_table->inverse().translation;
  const Eigen::AngleAxisd off(radFromDeg(off_deg), Eigen::Vector3d(1.0, -0.7, 0.4).normalized());
  Rigid3& pose = *calibration.cam_from_table;
  pose.rotation = off.toRotationMatrix() * pose.rotation;
  pose.translation = -(pose.rotation * centre);
  calibration.camera.fx *= 1.0 + focal_share;
  calibration.camera.fy *= 1.0 + focal_share;
  calibration.camera.k1 = k1;
  return calibration;
}

double turnedOff_deg(const SelfCalibration& solved) {
  const Eigen::Matrix3d left = solved.calibration.cam_from_table->rotation *
                               trueCalibration().cam_from_table->rotation.transpose();
  return degFromRad(Eigen::AngleAxisd(left).angle());
}

SelfCalibrationOptions unknownLens() {
  SelfCalibrationOptions options;
  options.focal_share = 1.0;
  options.centre_px = 1e-3;
  return options;
}

TEST(SelfCalibrate, FindsCameraAndAxisExactlyWithoutNoise) {
  const Turn turn = seenTurn(0.0, 0.0);
  SelfCalibrationOptions options = unknownLens();
  options.k1 = 10.0;
  options.angle_rad = 1e-6;
  const auto solved =
      selfCalibrate(turn.tracks, wrongCalibration(0.5, 0.04, 0.0), turn.angles, options, {});
  ASSERT_TRUE(solved) << solved.error().sentence();
  EXPECT_NEAR(solved->calibration.camera.fx, 1500.0, 0.05);
  EXPECT_NEAR(solved->calibration.camera.k1, -0.08, 1e-3);
  EXPECT_LT(turnedOff_deg(*solved), 1e-3);
  EXPECT_LT(solved->rms_after_px, 1e-3);
  EXPECT_GT(solved->rms_before_px, 1.0);
}

TEST(SelfCalibrate, ToldErrorBarHoldsWithNoiseAndWrongSightings) {
  const Turn turn = seenTurn(0.2, 0.05);
  const auto solved =
      selfCalibrate(turn.tracks, wrongCalibration(0.5, 0.04, 0.0), turn.angles, unknownLens(), {});
  ASSERT_TRUE(solved) << solved.error().sentence();
  EXPECT_GT(solved->focal_sigma_px, 0.3);
  EXPECT_LT(solved->focal_sigma_px, 15.0);
  EXPECT_LT(std::abs(solved->calibration.camera.fx - 1500.0), 4.0 * solved->focal_sigma_px);
  EXPECT_LT(turnedOff_deg(*solved), 0.1);
  EXPECT_NEAR(solved->rms_after_px, 0.2 * std::sqrt(2.0), 0.06);
}

TEST(SelfCalibrate, KeepsTheAngleThatFixesTheFrameAndFindsTheOthers) {
  Turn turn = seenTurn(0.05, 0.0);
  for (std::size_t view = 1; view < turn.angles.told_rad.size(); ++view) {
    turn.angles.told_rad[view] += radFromDeg(view % 2 == 0 ? 0.3 : -0.3);
  }
  const std::vector<double> truth_rad = turn.angles.start_rad;
  turn.angles.start_rad = turn.angles.told_rad;
  SelfCalibrationOptions options = unknownLens();
  options.angle_rad = radFromDeg(0.5);
  const auto solved = selfCalibrate(turn.tracks, trueCalibration(), turn.angles, options, {});
  ASSERT_TRUE(solved) << solved.error().sentence();
  EXPECT_EQ(solved->angles_rad[0], 0.0);
  for (std::size_t view = 1; view < truth_rad.size(); ++view) {
    EXPECT_NEAR(degFromRad(solved->angles_rad[view] - truth_rad[view]), 0.0, 0.03) << view;
  }
}

TEST(SelfCalibrate, HoldsTheFocalLengthThatIsKnown) {
  const Turn turn = seenTurn(0.2, 0.0);
  SelfCalibrationOptions options;
  options.focal_share = 1e-6;
  const auto solved = selfCalibrate(turn.tracks, trueCalibration(), turn.angles, options, {});
  ASSERT_TRUE(solved);
  EXPECT_NEAR(solved->calibration.camera.fx, 1500.0, 0.05);
}

TEST(SelfCalibrate, RefusesFewTracksAndStopsWhenAsked) {
  Turn turn = seenTurn(0.2, 0.0);
  std::stop_source stop;
  stop.request_stop();
  const auto stopped =
      selfCalibrate(turn.tracks, trueCalibration(), turn.angles, {}, Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
  turn.tracks.resize(49);
  const auto few = selfCalibrate(turn.tracks, trueCalibration(), turn.angles, {}, {});
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, Error::Code::kTooFew);
}

}  // namespace
}  // namespace gyre
