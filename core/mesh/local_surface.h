// The smooth surface that the points around a place suggest.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/mesh/kd_tree.h"

namespace gyre {

// A surface patch seen from above its tangent plane.
struct LocalSurface {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();  // where it passes below the place asked for, mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit; its sign is arbitrary
  // How it bends: over an offset d in the tangent plane it rises along the normal by d'Bd / 2.
  // [1/mm]
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();
  double residual_mm = 0.0;  // weighted r.m.s. distance of the points from it
  // Standard deviation of such points about the surface there truly is, which this one, bent
  // towards them, passes nearer; 0 when there are too few to tell.
  double scatter_mm = 0.0;
};

// Fits a plane, then a height field of second degree over it where six or more neighbours allow, to
// the neighbours, weighted by a Gaussian whose radius is the farthest neighbour's distance over
// two. Nothing with fewer than three neighbours, or when they lie on a line. Source: Cazals and
// Pouget, "Estimating differential quantities using polynomial fitting of osculating jets" (2005),
// second degree.
std::optional<LocalSurface> fitLocalSurface(const KdTree& points, const Eigen::Vector3d& place,
                                            std::span<const KdTree::Neighbour> neighbours);

}  // namespace gyre
