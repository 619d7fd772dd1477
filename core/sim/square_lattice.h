// Finds the lattice of squares whose corners are given.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace gyre {

struct LatticeFit {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();    // where (0, 0) lies, mm
  Eigen::Matrix2d step = Eigen::Matrix2d::Identity();  // columns: one on in i, one on in j; mm
  std::vector<Eigen::Array2i> index;                   // of each point
};

// The lattice with the shortest steps that holds all points to 0.05 mm, or nothing when there is
// none: fewer than three points, all in a line, or unevenly spaced. Turning from i to j goes from x
// to y.
std::optional<LatticeFit> fitLattice(const std::vector<Eigen::Vector2d>& points);

}  // namespace gyre
