// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/local_surface.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr double kFlat = 1e-9;  // second over first eigenvalue: below this the points are a line
constexpr std::size_t kQuadricUnknowns = 6;
// A surface that owes nearly all to its points passes through any of them.
constexpr double kLeastFree = 0.1;

struct Plane {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;  // columns: two tangents, then the normal
};

std::optional<Plane> fitPlane(const KdTree& points, std::span<const KdTree::Neighbour> neighbours,
                              const std::vector<double>& weight) {
  double sum = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    sum += weight[i];
    centre += weight[i] * points.point(neighbours[i].index);
  }
  centre /= sum;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Eigen::Vector3d offset = points.point(neighbours[i].index) - centre;
    scatter += weight[i] * offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);  // ascending
  const Eigen::Vector3d& values = solver.eigenvalues();
  if (!(values[1] > kFlat * values[2])) return std::nullopt;
  Plane plane{centre, {}};
  plane.axes.col(2) = solver.eigenvectors().col(0);
  plane.axes.col(0) = solver.eigenvectors().col(2);
  plane.axes.col(1) = plane.axes.col(2).cross(plane.axes.col(0));
  return plane;
}

}  // namespace

std::optional<LocalSurface> fitLocalSurface(const KdTree& points, const Eigen::Vector3d& place,
                                            std::span<const KdTree::Neighbour> neighbours) {
  if (neighbours.size() < 3) return std::nullopt;
  const double reach_mm = std::sqrt(neighbours.back().squared_mm2);
  if (!(reach_mm > 0.0)) return std::nullopt;
  std::vector<double> weight(neighbours.size());
  for (std::size_t i = 0; i < weight.size(); ++i) {
    weight[i] = std::exp(-2.0 * neighbours[i].squared_mm2 / (reach_mm * reach_mm));
  }
  const std::optional<Plane> plane = fitPlane(points, neighbours, weight);
  if (!plane) return std::nullopt;

  // Height over the plane: h(x, y) = c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2, with x and y
  // measured from the place in units of the reach, which keeps the normal equations well scaled.
  // A small ridge on the curvatures decides what few or badly spread neighbours leave open.
  const bool curved = neighbours.size() > kQuadricUnknowns;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> normal_matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 right = Vector6::Zero();
  std::vector<std::pair<Vector6, double>> rows;
  double sum = 0.0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Eigen::Vector3d local =
        plane->axes.transpose() * (points.point(neighbours[i].index) - place) / reach_mm;
    Vector6 row = Vector6::Zero();
    row.head<3>() << 1.0, local.x(), local.y();
    if (curved) {
      row.tail<3>() << local.x() * local.x(), local.x() * local.y(), local.y() * local.y();
    }
    normal_matrix += weight[i] * row * row.transpose();
    right += weight[i] * local.z() * row;
    rows.emplace_back(row, local.z());
    sum += weight[i];
  }
  normal_matrix.diagonal().head<3>().array() += 1e-9 * sum;
  normal_matrix.diagonal().tail<3>().array() += 1e-3 * sum;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(normal_matrix);
  const Vector6 c = solver.solve(right);
  if (!c.allFinite()) return std::nullopt;

  LocalSurface surface;
  double squares = 0.0;
  double free_weight = 0.0;  // what the surface does not owe to the points themselves
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double miss = rows[i].second - rows[i].first.dot(c);
    squares += weight[i] * miss * miss;
    free_weight += weight[i] * (1.0 - weight[i] * rows[i].first.dot(solver.solve(rows[i].first)));
  }
  surface.residual_mm = reach_mm * std::sqrt(squares / sum);
  if (free_weight > kLeastFree * sum) {
    surface.scatter_mm = reach_mm * std::sqrt(squares / free_weight);
  }
  surface.foot = place + reach_mm * c[0] * plane->axes.col(2);
  surface.normal = (plane->axes * Eigen::Vector3d(-c[1], -c[2], 1.0)).normalized();
  Eigen::Matrix2d second;
  second << 2.0 * c[3], c[4], c[4], 2.0 * c[5];
  const auto tangents = plane->axes.leftCols<2>();
  surface.bending = tangents * second * tangents.transpose() / reach_mm;
  return surface;
}

}  // namespace gyre
