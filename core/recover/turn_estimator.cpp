// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/turn_estimator.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/joint_angles.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 64;
constexpr double kCauchy_sigma = 2.385;

class TurnProblem {
 public:
  TurnProblem(std::span<const TrackSightings> tracks, std::span<const Rigid3> cam_from_table,
              const AngleKnowledge& angles, const RecoverOptions& options)
      : tracks_(tracks), told_(cam_from_table), prior_(angles.prior), options_(options) {
    estimate_.points.resize(tracks.size());
    estimate_.corrections_rad.assign(prior_.start_rad.begin(), prior_.start_rad.end());
    estimate_.corrections_rad.resize(told_.size(), 0.0);
    estimate_.sigma_rad.assign(angles.expected_sigma_rad.begin(), angles.expected_sigma_rad.end());
  }

  // Every point by itself, at the angles as they are known by now.
  Result<void> estimatePoints(const Task& task);
  // The angles and points together, from the sightings that agree by now.
  Result<void> solveAngles(double cauchy_sigma, const Task& task);

  TurnEstimate take() { return std::move(estimate_); }

 private:
  std::span<const TrackSightings> tracks_;
  std::span<const Rigid3> told_;
  AnglePrior prior_;
  const RecoverOptions& options_;
  TurnEstimate estimate_;
};

Result<void> TurnProblem::estimatePoints(const Task& task) {
  auto estimator = PointEstimator::create(options_);
  if (!estimator) return estimator.error();
  for (std::size_t view = 0; view < told_.size(); ++view) {
    estimator->addPose(told_[view] * baseFromTable(estimate_.corrections_rad[view]),
                       estimate_.sigma_rad[view]);
  }
  parallelFor(tracks_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const TrackSightings& track = tracks_[i];
      estimate_.points[i] = track.start ? estimator->estimateFrom(track.sightings, *track.start)
                                        : estimator->estimate(track.sightings, track.seed);
    }
  });
  if (task.stopRequested()) return cancelled();
  return {};
}

Result<void> TurnProblem::solveAngles(double cauchy_sigma, const Task& task) {
  std::vector<std::vector<Sighting>> agreeing;
  std::vector<std::size_t> of_track;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!estimate_.points[i]) continue;
    std::vector<Sighting>& kept = agreeing.emplace_back();
    for (std::size_t k = 0; k < tracks_[i].sightings.size(); ++k) {
      if (estimate_.points[i]->agrees[k] != 0) kept.push_back(tracks_[i].sightings[k]);
    }
    of_track.push_back(i);
  }
  std::vector<JointTrack> joint;
  joint.reserve(of_track.size());
  for (std::size_t j = 0; j < of_track.size(); ++j) {
    joint.push_back({agreeing[j], estimate_.points[of_track[j]]->position_in_table});
  }
  JointAnglesOptions options;
  options.cauchy_sigma = cauchy_sigma;
  AnglePrior prior = prior_;
  prior.start_rad = estimate_.corrections_rad;
  const auto solved = solveJointAngles(joint, told_, prior, options, task);
  if (!solved) {
    // Without a point there is nothing to correct, which is no failure.
    if (solved.error().code == Error::Code::kTooFew) return {};
    return solved.error();
  }
  estimate_.corrections_rad = solved->corrections_rad;
  estimate_.sigma_rad = solved->sigma_rad;
  for (std::size_t j = 0; j < of_track.size(); ++j) {
    EstimatedPoint& point = *estimate_.points[of_track[j]];
    point.position_in_table = solved->positions_in_table[j];
    point.covariance = std::max(1.0, point.chi2_per_freedom) * solved->covariances[j];
  }
  return {};
}

}  // namespace

Result<TurnEstimate> estimateTurn(std::span<const TrackSightings> tracks,
                                  std::span<const Rigid3> cam_from_table,
                                  const AngleKnowledge& angles, const RecoverOptions& options,
                                  const Task& task) {
  GYRE_CHECK(cam_from_table.size() == angles.expected_sigma_rad.size());
  GYRE_CHECK(cam_from_table.size() == angles.prior.sigma_rad.size());
  TurnProblem problem(tracks, cam_from_table, angles, options);
  if (auto done = problem.estimatePoints(task); !done) return done.error();
  const bool exact = std::all_of(angles.prior.sigma_rad.begin(), angles.prior.sigma_rad.end(),
                                 [](double sigma) { return sigma == 0.0; });
  if (exact || solverFromName(options.solver) != Solver::kRobust) return problem.take();
  task.report(0.3, "Solving the table's angles");
  if (auto done = problem.solveAngles(kCauchy_sigma, task.part(0.3, 0.6)); !done) {
    return done.error();
  }
  if (auto done = problem.estimatePoints(task); !done) return done.error();
  if (auto done = problem.solveAngles(std::numeric_limits<double>::infinity(), task.part(0.7, 1.0));
      !done) {
    return done.error();
  }
  return problem.take();
}

}  // namespace gyre
