// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/noise_trial.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/geometry/turn_between.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/cramer_rao.h"
#include "core/recover/turn_estimator.h"

namespace gyre {
namespace {

// Exact pixels still have a standard deviation, or nothing could be weighed.
constexpr double kLeastSigma_px = 1e-3;

// Every point is wanted, however little parallax or agreement it has: the experiment has no
// outliers, and a point that is dropped would flatter the mean.
RecoverOptions forAllPoints(const char* solver) {
  RecoverOptions options;
  options.solver = solver;
  options.min_parallax_deg = 1.0;
  options.min_views = 2;
  options.min_agreeing = 0.1;
  return options;
}

using Sightings = std::vector<std::vector<Sighting>>;  // one list a track

double sigmaOf(const SyntheticTurn& turn) {
  return std::max(turn.sigma_px, kLeastSigma_px) / turn.camera.fx;
}

Sightings sightingsOf(const SyntheticTurn& turn) {
  Sightings all(turn.tracks.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].reserve(turn.tracks[i].observations.size());
    for (const Observation& each : turn.tracks[i].observations) {
      all[i].push_back({each.view, turn.camera.normalizedFromPixel(each.pixel), sigmaOf(turn)});
    }
  }
  return all;
}

std::vector<double> sigmasOf(std::size_t views, double sigma_deg) {
  std::vector<double> sigmas_rad(views, radFromDeg(sigma_deg));
  sigmas_rad.front() = 0.0;  // the first view fixes the frame
  return sigmas_rad;
}

WayOutcome alone(const SyntheticTurn& turn, const Sightings& sightings, const char* solver,
                 std::span<const double> angle_sigma_rad) {
  auto estimator = PointEstimator::create(forAllPoints(solver)).value();
  for (std::size_t view = 0; view < turn.cam_from_table.size(); ++view) {
    estimator.addPose(turn.cam_from_table[view], angle_sigma_rad[view]);
  }
  WayOutcome outcome;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const auto point = estimator.estimate(sightings[i], i);
    if (!point) continue;
    outcome.sum_mm += (point->position_in_table - turn.points_in_table[i]).norm();
    ++outcome.found;
  }
  return outcome;
}

WayOutcome jointly(const SyntheticTurn& turn, const Sightings& sightings,
                   std::span<const double> angle_sigma_rad) {
  std::vector<TrackSightings> tracks;
  tracks.reserve(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) tracks.push_back({sightings[i], i});
  const auto solved = estimateTurn(tracks, turn.cam_from_table, {angle_sigma_rad, angle_sigma_rad},
                                   forAllPoints("robust"), Task());
  if (!solved) return {};
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> truth;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!solved->points[i]) continue;
    found.push_back(solved->points[i]->position_in_table);
    truth.push_back(turn.points_in_table[i]);
  }
  const Rigid3 turned = baseFromTable(turnBetween(found, truth));
  WayOutcome outcome;
  outcome.found = static_cast<int>(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    outcome.sum_mm += (turned * found[i] - truth[i]).norm();
  }
  return outcome;
}

}  // namespace

TrialOutcome noiseTrial(const SyntheticTurnOptions& options, double angle_freedom_deg,
                        std::uint64_t seed) {
  const SyntheticTurn turn = syntheticTurn(options, seed);
  const Sightings sightings = sightingsOf(turn);
  const std::vector<double> expected_rad =
      sigmasOf(turn.cam_from_table.size(), options.angle_noise_deg);
  const std::vector<double> freedom_rad = sigmasOf(turn.cam_from_table.size(), angle_freedom_deg);
  TrialOutcome outcome;
  for (std::size_t way = 0; way < kAloneSolvers.size(); ++way) {
    outcome.ways[way] = alone(turn, sightings, kAloneSolvers[way], expected_rad);
  }
  outcome.ways[kJointWay] = jointly(turn, sightings, freedom_rad);
  const auto bound = [&](std::span<const double> angle_sigma_rad, Solved solved) {
    return leastMeanError_mm(
        {turn.cam_from_table, turn.points_in_table, angle_sigma_rad, sigmaOf(turn)}, solved);
  };
  outcome.bound_mm = bound(expected_rad, Solved::kAlone);
  outcome.joint_bound_mm = bound(freedom_rad, Solved::kJointlyUpToTurn);
  return outcome;
}

}  // namespace gyre
