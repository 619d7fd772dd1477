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

// Indices of points no two of which are nearer than radius_mm, and near enough to every other point
// (Poisson disc), ascending. Taken in the order of `cost`, the least first, then of index.
std::vector<std::uint32_t> thinPoints(const KdTree& points, std::span<const double> cost,
                                      double radius_mm);

}  // namespace gyre
