// Makes a camera and the poses of its views fit their sightings in the least-squares sense.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/known_point.h"

namespace gyre {

// One picture of a target: a first guess of where it was, and what was seen of it.
struct CameraView {
  Rigid3 cam_from_target;
  std::vector<KnownPoint> points;
};

// Which parameters of the camera are found; the others stay as given. The focal length always is.
struct RefineOptions {
  bool free_aspect = true;       // fx and fy each, or in the given ratio
  bool free_skew = false;        // the paper's model has it; no camera of today does
  bool free_principal = true;    // hold it when one plane in one view is all there is
  bool free_k1 = true;           // radial distortion
  bool free_k2 = true;           // needs points near the rim of the picture
  bool free_tangential = false;  // p1 and p2
  bool free_k3 = false;          // wide angles only
  // Above zero, a miss of more than this many standard deviations pulls less than its square
  // (Cauchy's weights): for sightings of which some are wrong. [sigma], 0 or 1 .. 100
  double cauchy_sigma = 0.0;
};

// The order of a camera's parameters in the covariance.
enum CameraParameter { kFx, kFy, kSkew, kCx, kCy, kK1, kK2, kP1, kP2, kK3, kCameraParameters };
using CameraCovariance = Eigen::Matrix<double, kCameraParameters, kCameraParameters>;

struct RefinedCamera {
  CameraModel camera;
  std::vector<Rigid3> cam_from_target;                     // one a view
  std::vector<std::vector<Eigen::Vector2d>> residuals_px;  // one a point: seen minus computed
  // Of the camera's parameters, poses being free as well; widened by what the residuals exceed the
  // points' sigma_px, narrowed by what they fall below. Zero where held.
  CameraCovariance covariance = CameraCovariance::Zero();
  double rms_px = 0.0;  // root mean square length of the residuals
};

// Levenberg-Marquardt on the reprojection error over the chosen parameters and all poses, from a
// start that is nearly right. Deterministic.
//
// Fails when there are fewer equations than unknowns, when a number is not finite, when a point is
// behind the camera at the start, when the points do not determine the chosen parameters, and when
// the task is stopped.
Result<RefinedCamera> refineCamera(const CameraModel& start, const std::vector<CameraView>& views,
                                   const RefineOptions& options, const Task& task = {});

}  // namespace gyre
