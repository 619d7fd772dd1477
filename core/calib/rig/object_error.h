// What the uncertainty of a calibration does to an object that is scanned with it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/calib/rig/rig_projection.h"

namespace gyre {

// A ball on the table: what an object is taken for, before anybody scanned one.
struct ErrorProbe {
  double diameter_mm = 80.0;
  Eigen::Vector3d middle_in_table = {0.0, 0.0, 40.0};
};

// One standard deviation each.
struct ObjectError {
  double detail_mm = 0.0;   // rms over the surface, after the best similarity
  double size_share = 0.0;  // of the size
};

using RigCovarianceMatrix = Eigen::Matrix<double, kCameraSize + kAxisSize, kCameraSize + kAxisSize>;

// Points spread evenly over the ball's surface, less its underside. [mm, table frame]
std::vector<Eigen::Vector3d> probePoints(const ErrorProbe& probe);

// The angles of the table at which a camera on the x side sees a point of the ball: an arc of 100
// deg in steps of 5 about the one at which the surface there faces it. [rad]
std::vector<double> probeAngles(const ErrorProbe& probe, const Eigen::Vector3d& point_in_table);

// Each point is intersected from the views of its arc. With H = sum J^T J over the views, the point
// moves by dX = -H^-1 sum J^T J_c dc for an error dc of camera and axis; all points share dc, so
// what is no similarity of all of them is the error of detail.
ObjectError predictObjectError(const RigFrames& frames, const RigCovarianceMatrix& covariance,
                               const ErrorProbe& probe);

// What is left of displacements after the best small similarity, and its scale.
struct SimilarityRest {
  Eigen::MatrixXd rest;      // 3 n x columns
  Eigen::RowVectorXd scale;  // one a column
};
SimilarityRest withoutSimilarity(const std::vector<Eigen::Vector3d>& points,
                                 const Eigen::MatrixXd& displacements);

}  // namespace gyre
