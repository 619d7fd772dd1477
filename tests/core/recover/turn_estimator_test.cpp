// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/turn_estimator.h"

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turn_between.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/cramer_rao.h"
#include "core/sim/synthetic_turn.h"

namespace gyre {
namespace {

struct Trial {
  Trial(const SyntheticTurnOptions& options, std::uint64_t seed, double share_of_jumps = 0.0)
      : turn(syntheticTurn(options, seed)),
        angle_sigma_rad(turn.told_angles_rad.size(), radFromDeg(options.angle_noise_deg)) {
    angle_sigma_rad.front() = 0.0;
    Random random(seed);
    for (const Track& track : turn.tracks) {
      std::vector<Sighting>& seen = sightings.emplace_back();
      for (const Observation& each : track.observations) {
        Eigen::Vector2d pixel = each.pixel;
        if (random.uniform() < share_of_jumps) {
          pixel += Eigen::Vector2d(random.uniform(-40, 40), random.uniform(-40, 40));
        }
        seen.push_back(
            {each.view, turn.camera.normalizedFromPixel(pixel), turn.sigma_px / turn.camera.fx});
      }
    }
    for (std::size_t i = 0; i < sightings.size(); ++i) tracks.push_back({sightings[i], i});
  }

  Result<TurnEstimate> estimate(const RecoverOptions& options = {}, const Task& task = {}) const {
    return estimateTurn(tracks, turn.cam_from_table, {angle_sigma_rad, angle_sigma_rad}, options,
                        task);
  }

  // Mean distance from the truth of the points found, after the best rotation about the axis. [mm]
  double error_mm(const TurnEstimate& found) const {
    std::vector<Eigen::Vector3d> seen;
    std::vector<Eigen::Vector3d> truths;
    for (std::size_t i = 0; i < found.points.size(); ++i) {
      if (!found.points[i]) continue;
      seen.push_back(found.points[i]->position_in_table);
      truths.push_back(turn.points_in_table[i]);
    }
    const Rigid3 turned = baseFromTable(turnBetween(seen, truths));
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) sum += (turned * seen[i] - truths[i]).norm();
    const auto count = static_cast<double>(seen.size());
    EXPECT_GT(count, 0.95 * static_cast<double>(found.points.size()));
    return sum / count;
  }

  double bound_mm() const {
    return leastMeanError_mm({turn.cam_from_table, turn.points_in_table, angle_sigma_rad,
                              turn.sigma_px / turn.camera.fx},
                             Solved::kJointlyUpToTurn);
  }

  SyntheticTurn turn;
  std::vector<double> angle_sigma_rad;
  std::vector<std::vector<Sighting>> sightings;
  std::vector<TrackSightings> tracks;
};

SyntheticTurnOptions withAngles(double angle_noise_deg, int views = 20) {
  SyntheticTurnOptions options;
  options.views = views;
  options.angle_noise_deg = angle_noise_deg;
  return options;
}

TEST(EstimateTurn, WithExactAnglesIsThePapersPointByPoint) {
  const Trial trial(withAngles(0.0), 1);
  const auto found = trial.estimate();
  ASSERT_TRUE(found) << found.error().sentence();
  PointEstimator estimator = PointEstimator::create({}).value();
  for (const Rigid3& pose : trial.turn.cam_from_table) estimator.addPose(pose, 0.0);
  for (std::size_t i = 0; i < trial.tracks.size(); ++i) {
    const auto alone = estimator.estimate(trial.tracks[i].sightings, trial.tracks[i].seed);
    ASSERT_TRUE(alone);
    EXPECT_EQ(found->points[i].value().position_in_table, alone->position_in_table);
  }
  for (const double correction : found->corrections_rad) EXPECT_EQ(correction, 0.0);
}

// Mean error over the mean bound, over trials.
double overBound(const SyntheticTurnOptions& options, std::uint64_t trials) {
  double error = 0.0;
  double bound = 0.0;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const Trial trial(options, seed);
    const auto found = trial.estimate();
    EXPECT_TRUE(found);
    if (!found) return 1e9;
    error += trial.error_mm(*found);
    bound += trial.bound_mm();
  }
  return error / bound;
}

TEST(EstimateTurn, ComesWithinATenthOfTheBound) {
  EXPECT_LT(overBound(withAngles(0.2), 60), 1.10);
  EXPECT_LT(overBound(withAngles(1.0), 60), 1.12);
  EXPECT_LT(overBound(withAngles(1.0, 50), 30), 1.10);
}

TEST(EstimateTurn, WithstandsJumpsWhileTheAnglesAreWrong) {
  double clean = 0.0;
  double jumping = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SyntheticTurnOptions options = withAngles(0.3, 30);
    const Trial without(options, seed);
    const Trial with(options, seed, 0.2);
    const auto a = without.estimate();
    RecoverOptions forgiving;
    forgiving.min_agreeing = 0.4;
    const auto b = with.estimate(forgiving);
    ASSERT_TRUE(a);
    ASSERT_TRUE(b);
    clean += without.error_mm(*a) / 20.0;
    jumping += with.error_mm(*b) / 20.0;
  }
  EXPECT_LT(jumping, 1.3 * clean);  // a fifth fewer sightings alone cost a tenth
}

TEST(EstimateTurn, FindsASteadyErrorOfTheSteps) {
  SyntheticTurnOptions options = withAngles(0.0, 50);
  options.angle_scale_error = 0.01;
  Trial trial(options, 3);
  const auto believed = trial.estimate();
  ASSERT_TRUE(believed);
  trial.angle_sigma_rad.assign(50, radFromDeg(0.5));
  const auto solved = trial.estimate();
  ASSERT_TRUE(solved);
  EXPECT_LT(trial.error_mm(*solved), 0.25);
  EXPECT_GT(trial.error_mm(*believed), 4.0 * trial.error_mm(*solved));
}

// Told as a scale, 3 % pulls on nothing; told as errors of each view alone, it does.
TEST(EstimateTurn, FindsALargeErrorOfAllStepsWhenToldOfOne) {
  SyntheticTurnOptions options = withAngles(0.0, 50);
  options.angle_scale_error = 0.03;
  Trial trial(options, 3);
  trial.angle_sigma_rad.assign(50, radFromDeg(0.1));
  trial.angle_sigma_rad.front() = 0.0;
  const auto pulled = trial.estimate();
  const std::vector<double> loose(50, radFromDeg(1.0));
  const AnglePrior prior{trial.angle_sigma_rad, trial.turn.told_angles_rad, 0.05};
  const auto scaled = estimateTurn(trial.tracks, trial.turn.cam_from_table, {loose, prior}, {}, {});
  ASSERT_TRUE(pulled);
  ASSERT_TRUE(scaled);
  EXPECT_LT(trial.error_mm(*scaled), 0.25);
  const double truth_rad = 0.03 * trial.turn.told_angles_rad.back();
  EXPECT_NEAR(scaled->corrections_rad.back(), truth_rad, radFromDeg(0.1));
  EXPECT_LT(pulled->corrections_rad.back(), 0.9 * truth_rad);
  // Begun there, it stays there.
  AnglePrior begun = prior;
  begun.start_rad = scaled->corrections_rad;
  const auto again =
      estimateTurn(trial.tracks, trial.turn.cam_from_table, {scaled->sigma_rad, begun}, {}, {});
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->corrections_rad.back(), scaled->corrections_rad.back(), radFromDeg(0.02));
}

TEST(EstimateTurn, LeavesTheAnglesToThePapersSolvers) {
  const Trial trial(withAngles(0.5), 4);
  RecoverOptions options;
  options.solver = "squared";
  const auto found = trial.estimate(options);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->points.front());
  for (const double correction : found->corrections_rad) EXPECT_EQ(correction, 0.0);
}

TEST(EstimateTurn, HasNoPointsOfNoTracks) {
  Trial trial(withAngles(0.5), 5);
  trial.tracks.clear();
  const auto none = trial.estimate();
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->points.empty());
  trial.tracks.push_back({std::span(trial.sightings[0]).first(1), 1});
  const auto one = trial.estimate();
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->points.front());
}

TEST(EstimateTurn, StopsAndRefuses) {
  const Trial trial(withAngles(0.5), 6);
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = trial.estimate({}, Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
  RecoverOptions wrong;
  wrong.solver = "best";
  EXPECT_FALSE(trial.estimate(wrong));
}

}  // namespace
}  // namespace gyre
