// Tsai's camera model, and the way between it and Brown's.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

// Tsai's model. Its radial distortion acts from distorted to undistorted normalised coordinates,
//   x_u = x_d (1 + kappa1 r_d^2),   u = aspect focal_px x_d + cx,   v = focal_px y_d + cy,
// the other way round than Brown's. A kappa1 in mm^-2 on the sensor is this one over f_mm^2.
struct TsaiCamera {
  double focal_px = 0.0;  // along y
  double aspect = 1.0;    // fx / fy, Tsai's s_x
  Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();
  double kappa1 = 0.0;
  Rigid3 cam_from_target;
};

// The raw pixel of a point in the target frame, or nothing when it is not in front of the camera or
// so far aside that the distortion has no inverse.
std::optional<Eigen::Vector2d> projectTsai(const TsaiCamera& camera,
                                           const Eigen::Vector3d& point_in_target);

// The nearest Brown model: k1, k2, k3 fitted to Tsai's distortion out to a radius of undistorted
// normalised coordinates. Width and height stay 0. At a radius of 0 the power series of the
// inverse: k1 = -kappa1, k2 = 3 kappa1^2, k3 = -12 kappa1^3.
CameraModel brownFromTsai(const TsaiCamera& camera, double radius);

// The kappa1 nearest to the radial part of a Brown model out to that radius, which is > 0.
double kappa1FromBrown(const CameraModel& camera, double radius);

}  // namespace gyre
