// A half-line, and what it meets.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace gyre {

// Origin and unit direction in one frame, which the variable's name tells.
struct Ray {
  Eigen::Vector3d origin;     // mm
  Eigen::Vector3d direction;  // unit length
};

// Along which a camera sees a normalised picture coordinate: in frame A for a pose cam_from_A.
Ray rayThrough(const Rigid3& cam_from_frame, const Eigen::Vector2d& normalized);

// Distance of a point from the ray's whole line. [mm]
double distanceToLine(const Ray& ray, const Eigen::Vector3d& point);

// Where the ray meets the plane z = height_mm, or nothing when it runs parallel or away from it.
std::optional<Eigen::Vector3d> meetHorizontalPlane(const Ray& ray, double height_mm);

// The two distances along the ray at which its line enters and leaves the upright cylinder about
// the z axis, or nothing when it misses it. [mm]; the first may be negative.
struct Span {
  double from = 0.0;
  double to = 0.0;
};
std::optional<Span> crossCylinder(const Ray& ray, double radius_mm, double z_min_mm,
                                  double z_max_mm);

}  // namespace gyre
