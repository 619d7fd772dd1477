// Solids by formula: signed distances and how they blend. Negative inside, about mm outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Core>

namespace gyre::implicit {

inline double sphere(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, double radius) {
  return (p - centre).norm() - radius;
}

// First-order distance; exact on the surface.
inline double ellipsoid(const Eigen::Vector3d& p, const Eigen::Vector3d& centre,
                        const Eigen::Vector3d& radii) {
  const Eigen::Vector3d scaled = (p - centre).cwiseQuotient(radii);
  const double k0 = scaled.norm();
  const double k1 = scaled.cwiseQuotient(radii).norm();
  return k1 > 1e-12 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
}

// A rod from a to b whose radius changes evenly.
struct Rod {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  double radius_a;
  double radius_b;
};

inline double rod(const Eigen::Vector3d& p, const Rod& shape) {
  const Eigen::Vector3d ab = shape.b - shape.a;
  const double t = std::clamp((p - shape.a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - shape.a - t * ab).norm() - (shape.radius_a + t * (shape.radius_b - shape.radius_a));
}

// Union with a fillet of about the width given (polynomial smooth minimum).
inline double blend(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width * 0.25;
}

// Intersection with a rounded edge.
inline double cut(double a, double b, double width) { return -blend(-a, -b, width); }

// One smooth tube through the points given.
inline double tube(const Eigen::Vector3d& p, std::span<const Eigen::Vector4d> points_and_radii) {
  double distance = 1e9;
  for (std::size_t i = 0; i + 1 < points_and_radii.size(); ++i) {
    const Eigen::Vector4d& from = points_and_radii[i];
    const Eigen::Vector4d& to = points_and_radii[i + 1];
    distance =
        blend(distance, rod(p, {from.head<3>(), to.head<3>(), from.w(), to.w()}), 0.5 * from.w());
  }
  return distance;
}

}  // namespace gyre::implicit
