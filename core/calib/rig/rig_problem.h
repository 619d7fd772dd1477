// The joint least-squares problem of a rig: what is seen, what is unknown, how it is solved.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/rig/rig_bundle.h"
#include "core/calib/rig/rig_projection.h"

namespace gyre {

struct RigSighting {
  std::size_t view = 0;
  std::size_t point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 1.0;
  bool used = true;  // false: an outlier
};

// What does not change while solving.
struct RigScene {
  std::vector<TargetPiece> faces;    // the last holds what belongs to none, and never moves
  std::vector<FacePoint> points;     // one a point of the target
  std::vector<std::size_t> face_of;  // one a point
  std::vector<RigSighting> sightings;
  std::vector<std::optional<double>> commanded_rad;  // one a view, less the first view's
  bool has_page_axes = false;
};
RigScene sceneOf(std::span<const TargetView> views, const Target& target, TargetShape shape);

// What is solved, as it stands.
struct RigState {
  RigFrames frames;
  std::vector<double> angles_rad;                          // one a view; the first is 0 and stays
  double step_scale = 1.0;                                 // negative: the motor is reversed
  std::vector<Eigen::Matrix<double, kFaceSize, 1>> faces;  // one a face of the scene
  double page_stretch = 0.0;

  // The parameters of one sighting.
  RigParameters at(std::size_t view, std::size_t face) const;
};

// Which parameters may move. Everything that is not listed always does, except the first angle.
struct RigFreedom {
  std::array<bool, kCameraSize> camera{};
  bool axis = true;
  bool target = true;
  bool face_places = false;
  bool face_bows = false;
  bool page_stretch = false;
  bool step_scale = true;
};

// How far the sheets of a folded target are off, one standard deviation.
struct FoldPriors {
  double turn_rad = 0.0;
  double shift_mm = 0.0;
  double bow_mm = 0.0;

  Eigen::Matrix<double, kFaceSize, 1> sigmas() const;
};

// What is believed beforehand, one standard deviation each.
struct RigPriors {
  double angle_rad = 0.02;
  std::optional<FoldPriors> folds;  // none: faces lie anywhere
  double page_stretch = 0.0025;
};

// What one solve may move, what it believes beforehand, and how it weighs what is far off.
struct RigSolve {
  RigFreedom freedom;
  RigPriors priors;
  // Residuals beyond so many sigma lose weight (Cauchy); none: plain squares.
  std::optional<double> loss_scale;
};

// Moves the state to the least sum of squares, in units of the sightings' sigma.
Result<void> solveRig(const RigScene& scene, const RigSolve& solve, RigState& state,
                      const Task& task);

// Seen minus computed, one a sighting. [px]; not finite for a point behind the camera
std::vector<Eigen::Vector2d> residualsOf(const RigScene& scene, const RigState& state);

struct RigCovariance {
  std::vector<std::string> names;
  Eigen::MatrixXd matrix;
  double variance_factor = 1.0;  // found over stated variance of the sightings
  std::vector<Eigen::Matrix<double, kFaceSize, 1>> face_variances;  // zero where held
  // The part that a scan inherits: camera, then axis; zero where held.
  Eigen::Matrix<double, kCameraSize + kAxisSize, kCameraSize + kAxisSize> rig =
      Eigen::Matrix<double, kCameraSize + kAxisSize, kCameraSize + kAxisSize>::Zero();
};
// At the solution; empty names when the problem leaves something undetermined.
RigCovariance covarianceOf(const RigScene& scene, const RigFreedom& freedom,
                           const RigPriors& priors, const RigState& state);

}  // namespace gyre
