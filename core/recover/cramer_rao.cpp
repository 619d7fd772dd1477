// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/cramer_rao.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/base/check.h"
#include "core/recover/reprojection.h"

namespace gyre {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr int kQuadratureSteps = 400;

Eigen::Index pointAt(std::size_t views, std::size_t point) {
  return static_cast<Eigen::Index>(views + 3 * point);
}

// The information of all angles, then all points; angles that are known are left apart.
Eigen::MatrixXd jointInformation(const BoundScene& scene) {
  const std::size_t views = scene.cam_from_table.size();
  const Eigen::Index size = pointAt(views, scene.points_in_table.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  const double certainty = 1.0 / (scene.sigma * scene.sigma);
  for (std::size_t view = 0; view < views; ++view) {
    const auto v = static_cast<Eigen::Index>(view);
    const double sigma = scene.angle_sigma_rad[view];
    information(v, v) = sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0;
  }
  for (std::size_t point = 0; point < scene.points_in_table.size(); ++point) {
    const Eigen::Index p = pointAt(views, point);
    for (std::size_t view = 0; view < views; ++view) {
      const auto at = reproject(scene.cam_from_table[view], Eigen::Vector2d::Zero(),
                                scene.points_in_table[point]);
      if (!at) continue;
      const auto v = static_cast<Eigen::Index>(view);
      information.block<3, 3>(p, p) += certainty * at->by_position.transpose() * at->by_position;
      if (!(scene.angle_sigma_rad[view] > 0.0)) continue;
      information(v, v) += certainty * at->by_angle.squaredNorm();
      information.block<3, 1>(p, v) += certainty * at->by_position.transpose() * at->by_angle;
      information.block<1, 3>(v, p) = information.block<3, 1>(p, v).transpose();
    }
  }
  return information;
}

// Takes away of every point what one rotation about the axis explains best.
void removeTurn(std::span<const Eigen::Vector3d> points, Eigen::MatrixXd& covariance) {
  Eigen::VectorXd turn(covariance.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    turn.segment<3>(static_cast<Eigen::Index>(3 * i)) << -points[i].y(), points[i].x(), 0.0;
  }
  turn.normalize();
  const Eigen::VectorXd along = covariance * turn;
  covariance += turn.dot(along) * turn * turn.transpose() - along * turn.transpose() -
                turn * along.transpose();
}

double jointError(const BoundScene& scene, bool up_to_turn) {
  const Eigen::MatrixXd information = jointInformation(scene);
  const Eigen::LDLT<Eigen::MatrixXd> solver(information);
  if (!(solver.vectorD().minCoeff() > 0.0)) return kUnknown;
  const auto unknowns = static_cast<Eigen::Index>(3 * scene.points_in_table.size());
  const Eigen::MatrixXd all =
      solver.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  Eigen::MatrixXd covariance = all.bottomRightCorner(unknowns, unknowns);
  if (up_to_turn) removeTurn(scene.points_in_table, covariance);
  double sum = 0.0;
  for (Eigen::Index p = 0; p < unknowns; p += 3) sum += meanNorm(covariance.block<3, 3>(p, p));
  return sum / static_cast<double>(scene.points_in_table.size());
}

double errorAlone(const BoundScene& scene) {
  double sum = 0.0;
  for (const Eigen::Vector3d& point : scene.points_in_table) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (std::size_t view = 0; view < scene.cam_from_table.size(); ++view) {
      const auto at = reproject(scene.cam_from_table[view], Eigen::Vector2d::Zero(), point);
      if (!at) continue;
      const double angle_variance = scene.angle_sigma_rad[view] * scene.angle_sigma_rad[view];
      const Eigen::Matrix2d covariance = scene.sigma * scene.sigma * Eigen::Matrix2d::Identity() +
                                         angle_variance * at->by_angle * at->by_angle.transpose();
      information += at->by_position.transpose() * covariance.llt().solve(at->by_position);
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(information);
    if (!(solver.vectorD().minCoeff() > 0.0)) return kUnknown;
    sum += meanNorm(solver.solve(Eigen::Matrix3d::Identity()));
  }
  return sum / static_cast<double>(scene.points_in_table.size());
}

}  // namespace

// With Q = |x|^2, E sqrt(Q) = 1/sqrt(pi) * integral over t > 0 of (1 - E exp(-t^2 Q)) / t^2, and
// E exp(-s Q) = prod (1 + 2 s l_i)^(-1/2) over the covariance's eigenvalues l_i.
double meanNorm(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);
  const double scale = std::sqrt(variances.sum());
  if (!(scale > 0.0)) return 0.0;
  // t = u / (1 - u) maps the half line to (0, 1); Simpson's rule. At u = 0 the integrand is the
  // scaled trace, at 1 it is 1.
  const auto integrand = [&](double u) {
    if (u >= 1.0) return 1.0;
    const double t = u / (1.0 - u);
    double product = 1.0;
    for (const double variance : variances) {
      product *= 1.0 + 2.0 * t * t * variance / (scale * scale);
    }
    if (u < 1e-4) return 1.0;
    return (1.0 - 1.0 / std::sqrt(product)) / (u * u);
  };
  double sum = integrand(0.0) + integrand(1.0);
  for (int i = 1; i < kQuadratureSteps; ++i) {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(static_cast<double>(i) / kQuadratureSteps);
  }
  return scale * sum / (3.0 * kQuadratureSteps) / std::sqrt(std::numbers::pi);
}

double leastMeanError_mm(const BoundScene& scene, Solved solved) {
  GYRE_CHECK(scene.angle_sigma_rad.size() == scene.cam_from_table.size());
  if (solved == Solved::kAlone) return errorAlone(scene);
  return jointError(scene, solved == Solved::kJointlyUpToTurn);
}

}  // namespace gyre
