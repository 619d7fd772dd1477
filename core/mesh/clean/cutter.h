// The surfaces along which a mesh is cut: planes and a cylinder about the z axis.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace gyre {

// A plane across an axis of the table frame.
struct PlaneCutter {
  int axis = 2;
  double at_mm = 0.0;
  double side = 1.0;  // 1: what lies above is cut off, -1: what lies below

  // How far outside; negative inside. [mm]
  double outside_mm(const Eigen::Vector3d& place) const { return side * (place[axis] - at_mm); }
  // The share of the way from inside to outside at which the segment crosses.
  double crossing(const Eigen::Vector3d& inside, const Eigen::Vector3d& outside) const {
    return (at_mm - inside[axis]) / (outside[axis] - inside[axis]);
  }
  // Removes the rounding of a place that is on the surface.
  void settle(Eigen::Vector3d& place) const { place[axis] = at_mm; }
};

// What lies farther from the z axis than the radius is cut off.
struct CylinderCutter {
  double radius_mm = 0.0;

  double outside_mm(const Eigen::Vector3d& place) const {
    return place.head<2>().norm() - radius_mm;
  }
  double crossing(const Eigen::Vector3d& inside, const Eigen::Vector3d& outside) const {
    // |a + t d|^2 = r^2 has one root in (0, 1] when a is inside and a + d is not.
    const Eigen::Vector2d a = inside.head<2>();
    const Eigen::Vector2d d = outside.head<2>() - a;
    const double half_b = a.dot(d);
    const double c = a.squaredNorm() - radius_mm * radius_mm;
    const double root = std::sqrt(std::fmax(0.0, half_b * half_b - d.squaredNorm() * c));
    return (root - half_b) / d.squaredNorm();
  }
  void settle(Eigen::Vector3d& place) const {
    place.head<2>() *= radius_mm / place.head<2>().norm();
  }
};

}  // namespace gyre
