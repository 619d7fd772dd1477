// The ways in which a lattice of corners can lie on a face of a target.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/calib/corners/corner_lattice.h"
#include "core/calib/match/target_face.h"

namespace gyre {

// A lattice laid on a face: its cells, turned and shifted, are cells of the face's grid.
struct LatticeOnFace {
  int lattice = 0;   // index
  int face = 0;      // index into the target's faces
  int quarters = 0;  // how often the lattice is turned clockwise as seen from outside
  Eigen::Vector2i offset = Eigen::Vector2i::Zero();

  bool operator==(const LatticeOnFace&) const = default;
};

// The face's column and row of a lattice's; may lie outside the face.
Eigen::Vector2i cellOnFace(const LatticeOnFace& laid, const Eigen::Vector2i& cell);

// All ways to lay a lattice on a face, never mirrored. A lattice that has more than one corner in
// eight where the face has none is not of it. Empty for a face without a grid.
std::vector<LatticeOnFace> waysToLay(const CornerLattice& lattice, int lattice_index,
                                     const TargetFace& face);

// Whether dark squares lie where the target has them: 1 when they do, -1 when bright ones do, 0
// when the face does not tell.
double darkSquareMatch(const CornerLattice& lattice, const LatticeOnFace& laid,
                       const TargetFace& face);

}  // namespace gyre
