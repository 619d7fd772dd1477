// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/synthetic_turn.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

double rmsError_px(const SyntheticTurn& turn) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < turn.tracks.size(); ++i) {
    for (const Observation& seen : turn.tracks[i].observations) {
      const auto view = static_cast<std::size_t>(seen.view);
      const double off_rad = turn.true_angles_rad[view] - turn.told_angles_rad[view];
      const auto pixel = turn.camera.project(turn.cam_from_table[view] * baseFromTable(off_rad) *
                                             turn.points_in_table[i]);
      squares += (seen.pixel - *pixel).squaredNorm();
      count += 2.0;
    }
  }
  return std::sqrt(squares / count);
}

TEST(SyntheticTurn, IsExactWithoutNoise) {
  SyntheticTurnOptions options;
  options.whole_pixels = false;
  const SyntheticTurn turn = syntheticTurn(options, 1);
  EXPECT_EQ(turn.tracks.size(), 20U);
  EXPECT_EQ(turn.tracks.front().observations.size(), 20U);
  EXPECT_NEAR(turn.told_angles_rad.back(), radFromDeg(19 * 1.8), 1e-12);
  EXPECT_LT(rmsError_px(turn), 1e-9);
  EXPECT_EQ(turn.sigma_px, 0.0);
}

TEST(SyntheticTurn, ItsSigmaIsThatOfItsSightings) {
  for (const double noise_px : {0.0, 1.0, 5.0}) {
    SyntheticTurnOptions options;
    options.views = 200;
    options.noise_px = noise_px;
    const SyntheticTurn turn = syntheticTurn(options, 2);
    EXPECT_NEAR(rmsError_px(turn), turn.sigma_px, 0.03 * turn.sigma_px);
  }
}

TEST(SyntheticTurn, EverythingLiesInTheSphereAndBeforeTheCamera) {
  SyntheticTurnOptions options;
  options.points = 500;
  const SyntheticTurn turn = syntheticTurn(options, 3);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : turn.points_in_table) {
    EXPECT_LE(point.norm(), 200.0);
    mean += point / 500.0;
  }
  EXPECT_LT(mean.norm(), 15.0);
  EXPECT_NEAR((turn.cam_from_table.front() * Eigen::Vector3d::Zero()).z(), 900.0, 1e-9);
  const Eigen::Vector3d camera_in_table = turn.cam_from_table.front().inverse().translation;
  EXPECT_NEAR(camera_in_table.z(), 900.0 * std::sin(radFromDeg(25.0)), 1e-9);
}

TEST(SyntheticTurn, TheFirstAngleIsExactAndTheOthersScatterAsAsked) {
  SyntheticTurnOptions options;
  options.views = 200;
  options.angle_noise_deg = 1.0;
  options.angle_scale_error = 0.01;
  const SyntheticTurn turn = syntheticTurn(options, 4);
  EXPECT_EQ(turn.true_angles_rad.front(), 0.0);
  double squares = 0.0;
  for (std::size_t view = 1; view < 200; ++view) {
    const double off_rad = turn.true_angles_rad[view] - 1.01 * turn.told_angles_rad[view];
    squares += off_rad * off_rad / 199.0;
  }
  EXPECT_NEAR(degFromRad(std::sqrt(squares)), 1.0, 0.15);
}

TEST(SyntheticTurn, IsTheSameForTheSameSeedAlone) {
  const SyntheticTurn a = syntheticTurn({}, 5);
  const SyntheticTurn b = syntheticTurn({}, 5);
  const SyntheticTurn c = syntheticTurn({}, 6);
  EXPECT_EQ(a.points_in_table, b.points_in_table);
  EXPECT_EQ(a.tracks.back().observations.back().pixel, b.tracks.back().observations.back().pixel);
  EXPECT_NE(a.points_in_table, c.points_in_table);
}

}  // namespace
}  // namespace gyre
