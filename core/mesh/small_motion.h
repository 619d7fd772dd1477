// A small motion of a rigid surface, as least squares solve for it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "core/geometry/rigid3.h"

namespace gyre {

// Rotation vector about a centre times a size [mm], then shift [mm]: all six are alike in size.
using SmallMotion = Eigen::Matrix<double, 6, 1>;

// How a place moves with it. arm: from the centre to the place, in units of the size.
inline Eigen::Matrix<double, 3, 6> smallMotionJacobian(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << 0, arm.z(), -arm.y(), 1, 0, 0,  //
      -arm.z(), 0, arm.x(), 0, 1, 0,          //
      arm.y(), -arm.x(), 0, 0, 0, 1;
  return jacobian;
}

// The motion itself, not linearised.
inline Rigid3 rigidOf(const SmallMotion& motion, const Eigen::Vector3d& centre, double size_mm) {
  const Eigen::Vector3d rotation_vector = motion.head<3>() / size_mm;
  Rigid3 step;
  step.rotation = Eigen::AngleAxisd(rotation_vector.norm(), rotation_vector.stableNormalized())
                      .toRotationMatrix();
  step.translation = centre - step.rotation * centre + motion.tail<3>();
  return step;
}

}  // namespace gyre
