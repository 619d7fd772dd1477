// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/square_lattice.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <Eigen/QR>

namespace gyre {
namespace {

using Eigen::Vector2d;

constexpr double kOnLattice_mm = 0.05;
constexpr double kLeastSine = 0.5;  // between the two steps

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The shortest way between two points that is not along `other` (zero: any way).
Vector2d shortestStep(const std::vector<Vector2d>& points, const Vector2d& other) {
  Vector2d shortest = Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Vector2d step = points[j] - points[i];
      const double length = step.norm();
      if (length >= least - 1e-6 || length < 1e-6) continue;
      if (std::abs(cross(other, step)) < kLeastSine * other.norm() * length) continue;
      least = length;
      shortest = step;
    }
  }
  return shortest;
}

}  // namespace

std::optional<LatticeFit> fitLattice(const std::vector<Vector2d>& points) {
  LatticeFit fit;
  fit.step.col(0) = shortestStep(points, Vector2d::Zero());
  fit.step.col(1) = shortestStep(points, fit.step.col(0));
  const double area = fit.step.determinant();
  if (std::abs(area) < 1e-6) return std::nullopt;
  if (area < 0.0) fit.step.col(1) *= -1.0;
  // Small errors of the shortest steps would add up over the lattice: number outwards from the
  // first point, then fit origin and steps to all.
  const Eigen::Matrix2d cells_from_mm = fit.step.inverse();
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixX3d design(count, 3);
  Eigen::MatrixX2d places(count, 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array2d cells = (cells_from_mm * (points[i] - points[0])).array().round();
    fit.index.push_back(cells.cast<int>());
    design.row(static_cast<Eigen::Index>(i)) << 1.0, cells.x(), cells.y();
    places.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  }
  const Eigen::Matrix<double, 3, 2> solved = design.colPivHouseholderQr().solve(places);
  if (((design * solved - places).rowwise().norm().array() > kOnLattice_mm).any()) {
    return std::nullopt;
  }
  fit.origin = solved.row(0).transpose();
  fit.step = solved.bottomRows<2>().transpose();
  return fit;
}

}  // namespace gyre
