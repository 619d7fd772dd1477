// Makes points even: their spacing, and a selection no denser than wanted.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/kd_tree.h"

namespace gyre {

// The local spacing of points on a surface: the side of the square that each has to itself, judged
// by the distance of its eight nearest neighbours. [mm], one for each point
std::vector<double> localSpacing(const KdTree& points);

// The spacing that the share q of the points' area lies below. Sparse regions hold few points but
// much area, so each point counts with its own square. [mm]; 0 without points
double spacingQuantile(std::span<const double> spacing_mm, double q);

// What decides which points stay: one entry for each point.
struct ThinningInput {
  std::span<const double> cost;              // the least stays, then the lower index
  std::span<const Eigen::Vector3d> normals;  // unit, outward
  std::span<const double> radius_mm;         // how near another may not lie
};

// Indices, ascending, of points none of which lies nearer than its radius to one of less cost on
// the same side of the object, and that leave no other point of their side farther away from all
// (Poisson disc). Points whose normals are more than a right angle apart lie on different sides,
// those of a thin wall.
std::vector<std::uint32_t> thinPoints(const KdTree& points, const ThinningInput& input);

}  // namespace gyre
