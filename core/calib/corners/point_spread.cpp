// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/point_spread.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/base/check.h"

namespace gyre {
namespace {

// Of the largest extent. A bent sheet of paper reaches half of it.
constexpr double kFlat = 0.02;

}  // namespace

// Written so that sizes that are not numbers are degenerate.
bool PointSpread::onOneLine() const { return !(size_mm.y() > kFlat * size_mm.x()); }
bool PointSpread::inOnePlane() const { return !(size_mm.z() > kFlat * size_mm.x()); }

PointSpread spreadOf(std::span<const KnownPoint> points) {
  GYRE_CHECK(!points.empty());
  const auto count = static_cast<double>(points.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const KnownPoint& point : points) middle += point.position_in_target / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const KnownPoint& point : points) {
    const Eigen::Vector3d from_middle = point.position_in_target - middle;
    covariance += from_middle * from_middle.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);  // ascending
  PointSpread spread;
  spread.size_mm = solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  spread.principal_from_target.rotation = solver.eigenvectors().rowwise().reverse().transpose();
  if (spread.principal_from_target.rotation.determinant() < 0.0) {
    spread.principal_from_target.rotation.row(2) *= -1.0;
  }
  spread.principal_from_target.translation = -spread.principal_from_target.rotation * middle;
  return spread;
}

}  // namespace gyre
