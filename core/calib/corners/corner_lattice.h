// Joins X-corners to checkerboards: lattices, one a plane.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/calib/corners/x_corner_detector.h"

namespace gyre {

struct LatticeNode {
  Eigen::Vector2i cell = Eigen::Vector2i::Zero();  // column, row
  int corner = 0;                                  // index into the corners it was grown from
};

// Columns and rows begin at 0; columns to rows turn clockwise in the picture, as right to down
// does.
struct CornerLattice {
  std::vector<LatticeNode> nodes;                  // by row, then column; with holes
  Eigen::Vector2i size = Eigen::Vector2i::Zero();  // columns, rows
  bool origin_dark = false;  // the square right and down of cell (0, 0) is dark
};

struct CornerLatticeOptions {
  // How far a corner may be from where its neighbours predict it. [share of a square], (0, 0.5)
  double snap = 0.2;
  // Smaller ones are taken for chance. [corners], >= 4
  int min_nodes = 6;
  // The largest ones of a picture that are kept. [1, 100]
  int max_lattices = 8;

  Result<void> validate() const;
};

// By descending number of corners; each corner belongs to at most one lattice.
//
// From a seed whose edges lead to three more corners of a square, cell by cell: a cell is predicted
// by the homography of the cells around it, which a lens bends little, and taken when there is a
// corner whose edges run along the lattice and whose dark squares are where it must have them. So
// neither a gap ends a lattice nor does it cross to another plane. Every corner kept belongs to a
// whole square. Options out of range are a bug.
std::vector<CornerLattice> growLattices(std::span<const XCorner> corners,
                                        const CornerLatticeOptions& options = {});

}  // namespace gyre
