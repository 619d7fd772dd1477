// The least error that any unbiased way of finding points can have.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace gyre {

// Points that every view of a turn sees.
struct BoundScene {
  std::span<const Rigid3> cam_from_table;            // at the true angles
  std::span<const Eigen::Vector3d> points_in_table;  // mm
  std::span<const double> angle_sigma_rad;           // one a view; 0: the angle is known
  double sigma = 1e-4;  // standard deviation of a sighting's either coordinate, normalised
};

enum class Solved {
  kAlone,           // each point by itself; the angles' errors are noise of its sightings
  kJointly,         // all points and angles together
  kJointlyUpToTurn  // the same, judged after the best rotation of all points about the axis
};

// The mean over the points of E|error|, when errors are normal with the covariance that Cramer's
// and Rao's inequality leaves them. [mm] By a dense matrix of all unknowns: for a few hundred.
// Infinite when the views do not fix the points. Any thread.
double leastMeanError_mm(const BoundScene& scene, Solved solved);

// E|x| of a normal x with this covariance: one number for an error ellipsoid, of the same unit.
double meanNorm(const Eigen::Matrix3d& covariance);

}  // namespace gyre
