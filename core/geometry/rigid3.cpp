// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/rigid3.h"

#include <Eigen/LU>

namespace gyre {

Rigid3 Rigid3::inverse() const {
  const Eigen::Matrix3d transposed = rotation.transpose();
  return {transposed, -(transposed * translation)};
}

Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

bool isRigid(const Rigid3& transform, double tolerance) {
  if (!transform.rotation.allFinite() || !transform.translation.allFinite()) return false;
  const Eigen::Matrix3d product = transform.rotation.transpose() * transform.rotation;
  const double worst = (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return worst <= tolerance && transform.rotation.determinant() > 0.0;
}

}  // namespace gyre
