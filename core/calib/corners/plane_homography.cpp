// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/plane_homography.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Dense>

namespace gyre {
namespace {

// Moves the middle of the points to 0 and makes their mean distance sqrt 2.
template <class Get>
std::optional<Eigen::Matrix3d> normalizing(std::span<const PlaneSighting> sightings, Get get) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const PlaneSighting& s : sightings) middle += get(s);
  const auto count = static_cast<double>(sightings.size());
  middle /= count;
  double distance = 0.0;
  for (const PlaneSighting& s : sightings) distance += (get(s) - middle).norm() / count;
  if (!(distance > 0.0)) return std::nullopt;
  const double scale = std::sqrt(2.0) / distance;
  Eigen::Matrix3d normalized;
  normalized << scale, 0.0, -scale * middle.x(), 0.0, scale, -scale * middle.y(), 0.0, 0.0, 1.0;
  return normalized;
}

}  // namespace

std::optional<Eigen::Matrix3d> fitHomography(std::span<const PlaneSighting> sightings) {
  if (sightings.size() < 4) return std::nullopt;
  const auto from_place = normalizing(sightings, [](const auto& s) { return s.place; });
  const auto from_pixel = normalizing(sightings, [](const auto& s) { return s.pixel; });
  if (!from_place || !from_pixel) return std::nullopt;
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const PlaneSighting& s : sightings) {
    const Eigen::Vector3d p = *from_place * s.place.homogeneous();
    const Eigen::Vector3d q = *from_pixel * s.pixel.homogeneous();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = p.transpose();
    rows.block<1, 3>(0, 6) = -q.x() * p.transpose();
    rows.block<1, 3>(1, 3) = p.transpose();
    rows.block<1, 3>(1, 6) = -q.y() * p.transpose();
    normal += s.weight * s.weight * rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  // A second vanishing eigenvalue: the points do not tell the map.
  if (!(solver.eigenvalues()[1] > 1e-10 * solver.eigenvalues()[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Eigen::Matrix3d normalized;
  normalized << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  Eigen::Matrix3d pixel_from_place = from_pixel->inverse() * normalized * *from_place;
  // One sign for all denominators: positive where the points are.
  if (pixel_from_place.row(2).dot(sightings.front().place.homogeneous()) < 0.0) {
    pixel_from_place = -pixel_from_place;
  }
  return pixel_from_place / pixel_from_place.norm();
}

std::optional<Eigen::Matrix3d> fitHomographyNear(std::span<const PlaneSighting> sightings,
                                                 const Eigen::Vector2d& place,
                                                 std::size_t most_sightings) {
  std::vector<std::size_t> order(sightings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto distance = [&](std::size_t i) { return (sightings[i].place - place).squaredNorm(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  order.resize(std::min(order.size(), most_sightings));
  if (order.size() < 4) return std::nullopt;
  const double middle_distance = std::max(distance(order[order.size() / 2]), 1e-12);
  std::vector<PlaneSighting> near;
  near.reserve(order.size());
  for (const std::size_t i : order) {
    near.push_back(sightings[i]);
    near.back().weight /= 1.0 + distance(i) / middle_distance;
  }
  return fitHomography(near);
}

Eigen::Vector2d throughHomography(const Eigen::Matrix3d& pixel_from_place,
                                  const Eigen::Vector2d& place) {
  return (pixel_from_place * place.homogeneous()).hnormalized();
}

Eigen::Matrix2d homographyJacobian(const Eigen::Matrix3d& pixel_from_place,
                                   const Eigen::Vector2d& place) {
  const Eigen::Vector3d q = pixel_from_place * place.homogeneous();
  return (pixel_from_place.topLeftCorner<2, 2>() -
          q.hnormalized() * pixel_from_place.block<1, 2>(2, 0)) /
         q.z();
}

double leastStretch(const Eigen::Matrix2d& jacobian) {
  return jacobian.jacobiSvd().singularValues()[1];
}

}  // namespace gyre
