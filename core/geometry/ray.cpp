// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr double kParallel = 1e-12;

// The part of the line inside the slab z_min..z_max.
std::optional<Span> crossSlab(const Ray& ray, double z_min, double z_max) {
  const double slope = ray.direction.z();
  if (std::abs(slope) < kParallel) {
    if (ray.origin.z() < z_min || ray.origin.z() > z_max) return std::nullopt;
    return Span{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  const double at_min = (z_min - ray.origin.z()) / slope;
  const double at_max = (z_max - ray.origin.z()) / slope;
  return Span{std::min(at_min, at_max), std::max(at_min, at_max)};
}

}  // namespace

Ray rayThrough(const Rigid3& cam_from_frame, const Eigen::Vector2d& normalized) {
  const Eigen::Matrix3d frame_from_cam = cam_from_frame.rotation.transpose();
  return {-(frame_from_cam * cam_from_frame.translation),
          (frame_from_cam * Eigen::Vector3d(normalized.x(), normalized.y(), 1.0)).normalized()};
}

double distanceToLine(const Ray& ray, const Eigen::Vector3d& point) {
  return ray.direction.cross(point - ray.origin).norm();
}

std::optional<Eigen::Vector3d> meetHorizontalPlane(const Ray& ray, double height_mm) {
  if (std::abs(ray.direction.z()) < kParallel) return std::nullopt;
  const double distance = (height_mm - ray.origin.z()) / ray.direction.z();
  if (distance <= 0.0) return std::nullopt;
  return ray.origin + distance * ray.direction;
}

std::optional<Span> crossCylinder(const Ray& ray, double radius_mm, double z_min_mm,
                                  double z_max_mm) {
  const auto slab = crossSlab(ray, z_min_mm, z_max_mm);
  if (!slab) return std::nullopt;
  // |o + t d|^2 = r^2 in the horizontal plane.
  const Eigen::Vector2d o = ray.origin.head<2>();
  const Eigen::Vector2d d = ray.direction.head<2>();
  const double a = d.squaredNorm();
  const double c = o.squaredNorm() - radius_mm * radius_mm;
  Span span = *slab;
  if (a < kParallel) {
    if (c > 0.0) return std::nullopt;
  } else {
    const double b = o.dot(d);
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return std::nullopt;
    const double root = std::sqrt(discriminant);
    span.from = std::max(span.from, (-b - root) / a);
    span.to = std::min(span.to, (-b + root) / a);
  }
  if (span.from >= span.to) return std::nullopt;
  return span;
}

}  // namespace gyre
