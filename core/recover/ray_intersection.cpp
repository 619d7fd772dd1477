// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/ray_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace gyre {
namespace {

// Smallest over largest pivot of the normal equations below which the rays count as parallel:
// the square of a parallax of about 0.1 degrees.
constexpr double kSingular = 1e-6;

// Weiszfeld's iteration: a ray nearer than this weighs no more, or one would decide alone.
constexpr double kNear_mm = 1e-3;
constexpr double kSettled_mm = 1e-4;
constexpr int kAbsoluteRounds = 50;

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// weight: of a ray, above zero.
template <class Weight>
std::optional<Eigen::Vector3d> intersectWeighted(std::span<const Ray> rays, const Weight& weight) {
  if (rays.size() < 2) return std::nullopt;
  // A ray from c along d misses x by |P (x - c)| with P = I - d d^T. Summing the squares over all
  // rays and setting the gradient to zero leaves (sum P) x = sum P c. Origins are taken relative
  // to the first one, so that far-away frames cost no digits.
  const Eigen::Vector3d reference = rays.front().origin;
  double sum_w = 0.0;
  Eigen::Matrix3d sum_dd = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum_pc = Eigen::Vector3d::Zero();
  for (const Ray& ray : rays) {
    const double w = weight(ray);
    const Eigen::Vector3d& d = ray.direction;
    const Eigen::Vector3d c = ray.origin - reference;
    sum_w += w;
    sum_dd.noalias() += w * d * d.transpose();
    sum_pc += w * (c - d.dot(c) * d);
  }
  const Eigen::Matrix3d sum_p = sum_w * Eigen::Matrix3d::Identity() - sum_dd;
  const Eigen::LDLT<Eigen::Matrix3d> solver(sum_p);
  const Eigen::Vector3d pivots = solver.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return std::nullopt;
  return reference + solver.solve(sum_pc);
}

}  // namespace

std::optional<Eigen::Vector3d> intersectTwoRays(const Ray& first, const Ray& second,
                                                double min_parallax_rad) {
  // In the paper's letters: w = C_0 - C_k, and with b = e_0 . e_k the two distances are
  //   l_0 = (b q - p) / (1 - b^2),  l_k = (q - b p) / (1 - b^2),  p = e_0 . w,  q = e_k . w.
  const Eigen::Vector3d w = first.origin - second.origin;
  const double b = first.direction.dot(second.direction);
  const double p = first.direction.dot(w);
  const double q = second.direction.dot(w);
  const double determinant = 1.0 - b * b;
  const double sine = std::sin(min_parallax_rad);
  if (!(determinant >= sine * sine)) return std::nullopt;
  const double l_0 = (b * q - p) / determinant;
  const double l_k = (q - b * p) / determinant;
  if (!(l_0 > 0.0) || !(l_k > 0.0)) return std::nullopt;
  return 0.5 * (first.origin + l_0 * first.direction + second.origin + l_k * second.direction);
}

std::optional<Eigen::Vector3d> intersectRays(std::span<const Ray> rays) {
  return intersectWeighted(rays, [](const Ray&) { return 1.0; });
}

std::optional<Eigen::Vector3d> intersectRaysAbsolute(std::span<const Ray> rays) {
  auto point = intersectRays(rays);
  for (int round = 0; point && round < kAbsoluteRounds; ++round) {
    const Eigen::Vector3d before = *point;
    point = intersectWeighted(rays, [&](const Ray& ray) {
      return 1.0 / std::max(distanceToLine(ray, before), kNear_mm);
    });
    if (point && (*point - before).norm() < kSettled_mm) break;
  }
  return point;
}

double widestAngle(std::span<const Ray> rays) {
  if (rays.empty()) return 0.0;
  std::array<const Ray*, 2> widest = {&rays.front(), &rays.front()};
  double least_cosine = 1.0;
  for (const Ray& ray : rays) {
    for (const Ray* end : {&rays.front(), &rays.back()}) {
      const double cosine = ray.direction.dot(end->direction);
      if (cosine >= least_cosine) continue;
      least_cosine = cosine;
      widest = {&ray, end};
    }
  }
  return angleBetween(widest[0]->direction, widest[1]->direction);
}

}  // namespace gyre
