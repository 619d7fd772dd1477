// The solid that a target's sheets enclose.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Triangles, counter-clockwise from outside, that cover the convex hull of the points; where more
// than three points share a plane they overlap. Empty when all points lie in one plane.
std::vector<std::array<Eigen::Vector3d, 3>> convexHull(const std::vector<Eigen::Vector3d>& points);

}  // namespace gyre
