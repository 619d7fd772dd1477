// Cuts convex polygons.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace gyre {

// All places with normal . place <= most.
struct HalfPlane {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double most = 0.0;
};

// The part of a convex polygon in the half-plane, in the same order; empty when there is none.
std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d>& polygon,
                                     const HalfPlane& half);

}  // namespace gyre
