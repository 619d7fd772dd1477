// A rotation and a translation between two named frames.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace gyre {

// Named b_from_a: maps x_in_a to x_in_b = b_from_a * x_in_a, so that products cancel.
struct Rigid3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // orthonormal, determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   // mm

  Rigid3 inverse() const;
};

inline Eigen::Vector3d operator*(const Rigid3& b_from_a, const Eigen::Vector3d& x_in_a) {
  return b_from_a.rotation * x_in_a + b_from_a.translation;
}

Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a);

// True when every number is finite and the rotation is orthonormal and not a reflection, to the
// tolerance per entry of R^T R.
bool isRigid(const Rigid3& transform, double tolerance = 1e-4);

}  // namespace gyre
