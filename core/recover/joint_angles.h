// The table's true angle in every view, told by all tracks together.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/recover/angle_prior.h"
#include "core/recover/sighting.h"

namespace gyre {

// A track whose point is roughly known.
struct JointTrack {
  std::span<const Sighting> sightings;                          // only those that agree
  Eigen::Vector3d position_in_table = Eigen::Vector3d::Zero();  // mm
};

struct JointAngles {
  std::vector<double> corrections_rad;  // one a view: to be added to the table's angle
  // Standard deviations of these, once the turn of all views together is taken away, which no
  // picture shows and which only turns the model.
  std::vector<double> sigma_rad;
  std::vector<Eigen::Vector3d> positions_in_table;  // one a track, mm
  std::vector<Eigen::Matrix3d> covariances;         // mm^2, with the uncertainty of the angles
  double chi2_per_freedom = 0.0;                    // near 1 when every sigma is right
};

struct JointAnglesOptions {
  int most_steps = 20;
  // A sighting this many standard deviations off counts half. Infinite: plain least squares.
  double cauchy_sigma = 2.385;
};

// An error of the motor shifts every point of that picture alike, and that is how it is told from
// errors of the sightings: the angles and all points are solved together, the points eliminated
// (Schur's complement), with how far the angles may be off as prior knowledge.
//
// cam_from_table: one a view, at the angles told. The tracks' positions fit prior.start_rad.
// kTooFew when no track fixes its point, kCancelled when stopped. Costs grow with the sum of the
// tracks' squared lengths. The same result for any number of threads.
//
// Leow et al. (2000) find every point alone; Triggs et al., "Bundle adjustment" (2000), section 6.
Result<JointAngles> solveJointAngles(std::span<const JointTrack> tracks,
                                     std::span<const Rigid3> cam_from_table,
                                     const AnglePrior& prior, const JointAnglesOptions& options,
                                     const Task& task);

}  // namespace gyre
