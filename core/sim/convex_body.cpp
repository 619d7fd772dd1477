// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/convex_body.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr double kOnPlane_mm = 1e-6;

}  // namespace

// Every three points whose plane has all others on one side: a target has a few dozen points.
std::vector<std::array<Eigen::Vector3d, 3>> convexHull(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  const auto add_if_outside = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
    const Eigen::Vector3d scaled = (b - a).cross(c - a);
    if (scaled.norm() < kOnPlane_mm) return;
    const Eigen::Vector3d normal = scaled.normalized();
    double highest = 0.0;
    double lowest = 0.0;
    for (const Eigen::Vector3d& point : points) {
      highest = std::max(highest, normal.dot(point - a));
      lowest = std::min(lowest, normal.dot(point - a));
    }
    const bool flat = highest - lowest <= kOnPlane_mm;
    if (flat) return;
    if (highest <= kOnPlane_mm) triangles.push_back({a, b, c});
    if (lowest >= -kOnPlane_mm) triangles.push_back({a, c, b});
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        add_if_outside(points[i], points[j], points[k]);
      }
    }
  }
  return triangles;
}

}  // namespace gyre
