// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_bundle.h"

#include <algorithm>
#include <cmath>

#include "core/calib/rig/rig_problem.h"
#include "core/calib/rig/rig_refusals.h"
#include "core/calib/rig/rig_report.h"
#include "core/calib/rig/rig_start.h"

namespace gyre {
namespace {

constexpr int kRobustRounds = 3;
constexpr int kCleanRounds = 3;
constexpr double kLossOverScatter = 2.5;    // where sightings begin to lose weight
constexpr double kRayleighMedian = 1.1774;  // median length of a 2-D residual of unit sigma

constexpr int kLearningRounds = 12;
constexpr double kSettled = 0.9;         // standard deviations that change less are learned
constexpr double kLeastFold_rad = 1e-6;  // exact, for all that pictures show
constexpr double kLeastFold_mm = 1e-4;

// A range of a face's parameters that share a prior.
struct FaceGroup {
  int first;
  int count;
};

// The robust standard deviation of a coordinate, in units of what was stated.
double scatterOf(const RigScene& scene, const RigState& state) {
  const std::vector<Eigen::Vector2d> residuals = residualsOf(scene, state);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    lengths.push_back(residuals[i].norm() / scene.sightings[i].sigma_px);
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / kRayleighMedian;
}

RigFreedom fullFreedom(const RigBundleOptions& options, const RigScene& scene) {
  RigFreedom freedom;
  const FreeIntrinsics& free = options.free;
  if (!options.fixed_camera) {
    freedom.camera = {free.focal_length,      free.aspect,
                      free.principal_point,   free.principal_point,
                      free.radial_terms >= 1, free.radial_terms >= 2,
                      free.radial_terms >= 3, free.tangential,
                      free.tangential};
  }
  const bool loose = options.shape == TargetShape::kLooseMarkers;
  const bool sheets = options.shape == TargetShape::kFreeFaces;
  freedom.target = !loose;  // the markers' own places say it all
  // A single sheet's place is the target's.
  freedom.face_places = loose || (sheets && scene.faces.size() > 2);
  freedom.face_bows = sheets;
  freedom.page_stretch = scene.has_page_axes;
  return freedom;
}

// The same with the lens undistorted and centred and the target exact: hard to lead astray.
RigFreedom firstFreedom(RigFreedom freedom, const RigBundleOptions& options) {
  const bool focal = freedom.camera[0];
  freedom.camera.fill(false);
  freedom.camera[0] = focal;
  if (options.shape != TargetShape::kLooseMarkers) freedom.face_places = false;
  freedom.face_bows = false;
  freedom.page_stretch = false;
  return freedom;
}

RigPriors priorsOf(const RigBundleOptions& options) {
  RigPriors priors;
  priors.angle_rad = options.angle_prior_rad;
  if (options.shape == TargetShape::kFreeFaces) {
    priors.folds = {options.fold_sigma_rad, options.fold_sigma_mm, options.fold_sigma_mm};
  }
  // The difference of two independent readings, or of what the printer does to two directions.
  const double share = options.caliper_sigma_mm ? *options.caliper_sigma_mm / options.ruler_mm
                                                : options.printer_sigma;
  priors.page_stretch = std::sqrt(2.0) * share;
  return priors;
}

// Robust rounds, each with the loss narrowed to the scatter the last one left.
Result<void> solveRobustly(const RigScene& scene, const RigFreedom& freedom,
                           const RigPriors& priors, RigState& state, const Task& task) {
  for (int round = 0; round < kRobustRounds; ++round) {
    const double loss = kLossOverScatter * std::max(scatterOf(scene, state), 1e-3);
    if (auto solved = solveRig(scene, {freedom, priors, loss}, state, task); !solved) return solved;
  }
  return {};
}

// One MacKay step for the standard deviation of a group of face parameters: their squares over how
// many of them the pictures, rather than the prior, decide.
double learnedSigma(const RigState& state, const RigCovariance& covariance, FaceGroup group,
                    double sigma) {
  double squares = 0.0;
  double decided = 0.0;
  for (std::size_t face = 0; face + 1 < state.faces.size(); ++face) {
    for (int i = group.first; i < group.first + group.count; ++i) {
      const double variance = covariance.face_variances[face][i];
      if (!(variance > 0.0)) continue;
      squares += state.faces[face][i] * state.faces[face][i];
      decided += std::max(0.0, 1.0 - variance / (sigma * sigma));
    }
  }
  return decided > 0.0 ? std::sqrt(squares / decided) : sigma;
}

// How well the target was folded is learned from the target itself: priors as wide as folds may be
// at worst would let the noise of the pictures bend a target that is exact.
Result<void> learnFolds(const RigScene& scene, const RigFreedom& freedom, RigPriors& priors,
                        RigState& state, const Task& task) {
  if (!priors.folds) return {};
  for (int round = 0; round < kLearningRounds; ++round) {
    const RigCovariance covariance = covarianceOf(scene, freedom, priors, state);
    if (covariance.names.empty()) return {};
    FoldPriors& folds = *priors.folds;
    const FoldPriors before = folds;
    const auto learn = [&](FaceGroup group, double least, double& sigma) {
      sigma = std::clamp(learnedSigma(state, covariance, group, sigma), least, sigma);
    };
    learn({0, 3}, kLeastFold_rad, folds.turn_rad);
    learn({3, 3}, kLeastFold_mm, folds.shift_mm);
    learn({6, 3}, kLeastFold_mm, folds.bow_mm);
    if (auto solved = solveRig(scene, {freedom, priors, std::nullopt}, state, task); !solved) {
      return solved;
    }
    const bool settled = folds.turn_rad > kSettled * before.turn_rad &&
                         folds.shift_mm > kSettled * before.shift_mm &&
                         folds.bow_mm > kSettled * before.bow_mm;
    if (settled) break;
  }
  return {};
}

// Drops what is far off and solves the rest with plain squares, until nothing changes.
Result<void> solveCleanly(RigScene& scene, const RigSolve& solve, RigState& state,
                          double outlier_sigma, const Task& task) {
  for (int round = 0; round < kCleanRounds; ++round) {
    const double limit = outlier_sigma * std::max(scatterOf(scene, state), 1e-3);
    const std::vector<Eigen::Vector2d> residuals = residualsOf(scene, state);
    bool changed = false;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      RigSighting& seen = scene.sightings[i];
      const bool used = residuals[i].norm() <= limit * seen.sigma_px;
      changed = changed || used != seen.used;
      seen.used = used;
    }
    if (round > 0 && !changed) break;
    if (auto solved = solveRig(scene, solve, state, task); !solved) {
      return solved;
    }
  }
  return {};
}

}  // namespace

Result<RigCalibration> calibrateRig(std::span<const TargetView> views, const Target& target,
                                    const RigBundleOptions& options, const Task& task) {
  if (auto valid = options.validate(); !valid) return valid.error();
  if (auto valid = checkViews(views, target, options); !valid) return valid.error();
  task.report(0.0, "Looking for the axis");
  RigScene scene = sceneOf(views, target, options.shape);
  auto start = startOf(views, target, scene, options, task);
  if (!start) return start.error();
  RigState state = std::move(*start);
  if (auto enough = checkArc(scene, state, options); !enough) return enough.error();

  RigPriors priors = priorsOf(options);
  const RigFreedom freedom = fullFreedom(options, scene);
  task.report(0.2, "Fitting axis and angles");
  if (auto solved = solveRobustly(scene, firstFreedom(freedom, options), priors, state, task);
      !solved) {
    return solved.error();
  }
  if (auto standing = checkNotFlat(scene, state, options); !standing) return standing.error();
  task.report(0.4, "Fitting everything");
  if (auto solved = solveRobustly(scene, freedom, priors, state, task); !solved) {
    return solved.error();
  }
  if (auto fits = checkFits(scene, state, options, target.name); !fits) return fits.error();
  task.report(0.7, "Leaving out what does not fit");
  if (auto solved =
          solveCleanly(scene, {freedom, priors, std::nullopt}, state, options.outlier_sigma, task);
      !solved) {
    return solved.error();
  }
  if (auto solved = learnFolds(scene, freedom, priors, state, task); !solved) {
    return solved.error();
  }
  if (auto enough = checkArc(scene, state, options); !enough) return enough.error();

  task.report(0.9, "Judging the result");
  settleFrames(scene, options.shape, state);
  const RigCovariance covariance = covarianceOf(scene, freedom, priors, state);
  if (covariance.names.empty()) {
    return Error{Error::Code::kTooFew, "The pictures do not fix camera and axis.",
                 "Take more pictures all around, or hold the intrinsics (--intrinsics FILE)."};
  }
  task.report(1.0, "Done");
  return resultOf(views, target, options, {scene, state, covariance});
}

}  // namespace gyre
