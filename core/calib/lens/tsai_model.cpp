// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/tsai_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr int kMostSteps = 50;

// r_d with  r_d (1 + kappa1 r_d^2) = r_u, the branch that begins at 0.
std::optional<double> distortedRadius(double kappa1, double undistorted) {
  // With kappa1 < 0 the cubic rises only up to r_d^2 = -1 / (3 kappa1).
  double radius = undistorted;
  if (kappa1 < 0.0) {
    const double top = std::sqrt(-1.0 / (3.0 * kappa1));
    if (undistorted > top * 2.0 / 3.0) return std::nullopt;
    radius = std::min(radius, top);
  }
  for (int step = 0; step < kMostSteps; ++step) {
    const double slope = 1.0 + 3.0 * kappa1 * radius * radius;
    if (!(slope > 0.0)) return radius;  // at the top itself
    const double change = (radius * (1.0 + kappa1 * radius * radius) - undistorted) / slope;
    radius -= change;
    if (std::abs(change) < 1e-15) break;
  }
  return radius;
}

}  // namespace

std::optional<Eigen::Vector2d> projectTsai(const TsaiCamera& camera,
                                           const Eigen::Vector3d& point_in_target) {
  const Eigen::Vector3d point_in_cam = camera.cam_from_target * point_in_target;
  if (!(point_in_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d undistorted = point_in_cam.hnormalized();
  const double radius = undistorted.norm();
  const auto distorted = distortedRadius(camera.kappa1, radius);
  if (!distorted) return std::nullopt;
  const Eigen::Vector2d normalized =
      radius > 0.0 ? Eigen::Vector2d(undistorted * (*distorted / radius)) : undistorted;
  return camera.principal_px +
         camera.focal_px * Eigen::Vector2d(camera.aspect * normalized.x(), normalized.y());
}

CameraModel brownFromTsai(const TsaiCamera& camera, double radius) {
  CameraModel brown;
  brown.fy = camera.focal_px;
  brown.fx = camera.aspect * camera.focal_px;
  brown.cx = camera.principal_px.x();
  brown.cy = camera.principal_px.y();
  const double kappa1 = camera.kappa1;
  brown.k1 = -kappa1;
  brown.k2 = 3.0 * kappa1 * kappa1;
  brown.k3 = -12.0 * kappa1 * kappa1 * kappa1;
  if (!(radius > 0.0)) return brown;
  // r_d - r_u = r_u (k1 r_u^2 + k2 r_u^4 + k3 r_u^6), in units of the radius to keep the columns
  // alike.
  constexpr int kSteps = 100;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int i = 1; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const auto distorted = distortedRadius(kappa1, part * radius);
    if (!distorted) break;
    const double part2 = part * part;
    const Eigen::Vector3d row = part * part2 * Eigen::Vector3d(1.0, part2, part2 * part2);
    normal += row * row.transpose();
    right += row * (*distorted / radius - part);
  }
  const Eigen::Vector3d k = normal.ldlt().solve(right);
  const double r2 = radius * radius;
  brown.k1 = k[0] / r2;
  brown.k2 = k[1] / (r2 * r2);
  brown.k3 = k[2] / (r2 * r2 * r2);
  return brown;
}

double kappa1FromBrown(const CameraModel& camera, double radius) {
  // r_u - r_d = kappa1 r_d^3
  constexpr int kSteps = 100;
  double above = 0.0;
  double below = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double undistorted = radius * i / kSteps;
    const double r2 = undistorted * undistorted;
    const double distorted =
        undistorted * (1.0 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3)));
    const double cube = distorted * distorted * distorted;
    above += cube * (undistorted - distorted);
    below += cube * cube;
  }
  return below > 0.0 ? above / below : 0.0;
}

}  // namespace gyre
