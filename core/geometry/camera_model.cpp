// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/camera_model.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace gyre {
namespace {

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

Distorted distort(const CameraModel& camera, const Eigen::Vector2d& normalized) {
  const double x = normalized.x();
  const double y = normalized.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3));
  const double radial_slope = camera.k1 + r2 * (2.0 * camera.k2 + 3.0 * r2 * camera.k3);
  Distorted result;
  result.point = {x * radial + 2.0 * camera.p1 * x * y + camera.p2 * (r2 + 2.0 * x * x),
                  y * radial + camera.p1 * (r2 + 2.0 * y * y) + 2.0 * camera.p2 * x * y};
  const double mixed = 2.0 * x * y * radial_slope + 2.0 * camera.p1 * x + 2.0 * camera.p2 * y;
  result.jacobian << radial + 2.0 * x * x * radial_slope + 2.0 * camera.p1 * y +
                         6.0 * camera.p2 * x,
      mixed, mixed, radial + 2.0 * y * y * radial_slope + 6.0 * camera.p1 * y + 2.0 * camera.p2 * x;
  return result;
}

}  // namespace

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& point_in_cam) const {
  if (!(point_in_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d normalized = point_in_cam.head<2>() / point_in_cam.z();
  // Far outside the picture the polynomial folds back into it: no lens images those points there.
  const double r2 = normalized.squaredNorm();
  if (1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3)) <= 0.0) return std::nullopt;
  return pixelFromNormalized(normalized);
}

Eigen::Vector2d CameraModel::pixelFromNormalized(const Eigen::Vector2d& normalized) const {
  const Eigen::Vector2d distorted = distort(*this, normalized).point;
  return {fx * distorted.x() + skew * distorted.y() + cx, fy * distorted.y() + cy};
}

Eigen::Vector2d CameraModel::normalizedFromPixel(const Eigen::Vector2d& pixel) const {
  const double y_distorted = (pixel.y() - cy) / fy;
  const Eigen::Vector2d wanted((pixel.x() - cx - skew * y_distorted) / fx, y_distorted);
  Eigen::Vector2d normalized = wanted;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Distorted there = distort(*this, normalized);
    const Eigen::Vector2d step = there.jacobian.inverse() * (wanted - there.point);
    normalized += step;
    if (step.squaredNorm() < 1e-24) break;
  }
  return normalized;
}

Eigen::Matrix2d CameraModel::pixelJacobian(const Eigen::Vector2d& normalized) const {
  Eigen::Matrix2d pixel_from_distorted;
  pixel_from_distorted << fx, skew, 0.0, fy;
  return pixel_from_distorted * distort(*this, normalized).jacobian;
}

Eigen::Vector3d CameraModel::rayInCam(const Eigen::Vector2d& pixel) const {
  return normalizedFromPixel(pixel).homogeneous().normalized();
}

bool CameraModel::contains(const Eigen::Vector2d& pixel, double margin_px) const {
  return pixel.x() >= margin_px && pixel.y() >= margin_px &&
         pixel.x() <= width_px - 1 - margin_px && pixel.y() <= height_px - 1 - margin_px;
}

}  // namespace gyre
