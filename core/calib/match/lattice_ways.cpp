// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/lattice_ways.h"

#include <algorithm>

namespace gyre {
namespace {

constexpr int kMostOutside = 8;  // one corner in that many

// Clockwise in a picture whose y points down: right becomes down.
Eigen::Vector2i turned(const Eigen::Vector2i& cell, int quarters) {
  Eigen::Vector2i result = cell;
  for (int k = 0; k < quarters; ++k) result = Eigen::Vector2i(-result.y(), result.x());
  return result;
}

}  // namespace

Eigen::Vector2i cellOnFace(const LatticeOnFace& laid, const Eigen::Vector2i& cell) {
  return turned(cell, laid.quarters) + laid.offset;
}

std::vector<LatticeOnFace> waysToLay(const CornerLattice& lattice, int lattice_index,
                                     const TargetFace& face) {
  std::vector<LatticeOnFace> ways;
  if (!face.grid) return ways;
  const Eigen::Vector2i room(face.grid->columns, face.grid->rows);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const Eigen::Vector2i far = turned(lattice.size - Eigen::Vector2i::Ones(), quarters);
    const Eigen::Vector2i least = far.cwiseMin(Eigen::Vector2i::Zero());
    const Eigen::Vector2i size = far.cwiseAbs() + Eigen::Vector2i::Ones();
    const Eigen::Vector2i spare = room - size;
    for (int y = std::min(0, spare.y()); y <= std::max(0, spare.y()); ++y) {
      for (int x = std::min(0, spare.x()); x <= std::max(0, spare.x()); ++x) {
        const LatticeOnFace way{lattice_index, face.index, quarters, Eigen::Vector2i(x, y) - least};
        const auto outside =
            std::count_if(lattice.nodes.begin(), lattice.nodes.end(), [&](const LatticeNode& node) {
              const Eigen::Vector2i cell = cellOnFace(way, node.cell);
              return face.grid->cornerAt(cell.x(), cell.y()) < 0;
            });
        if (outside * kMostOutside <= static_cast<int>(lattice.nodes.size())) ways.push_back(way);
      }
    }
  }
  return ways;
}

double darkSquareMatch(const CornerLattice& lattice, const LatticeOnFace& laid,
                       const TargetFace& face) {
  if (!face.grid || face.corners.empty()) return 0.0;
  // The square at the first corner of the face towards its last one is dark: where that square is
  // in the grid, as its upper left corner.
  const FaceGrid& grid = *face.grid;
  Eigen::Vector2i first = Eigen::Vector2i::Zero();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.cornerAt(column, row) == 0) first = {column, row};
    }
  }
  const Eigen::Vector2d towards = face.corners.back().place_mm - face.corners.front().place_mm;
  const Eigen::Vector2i dark =
      first + Eigen::Vector2i(towards.x() < 0.0 ? -1 : 0, towards.y() < 0.0 ? -1 : 0);
  // The square right and down of the lattice's (0, 0): its corners, turned.
  const Eigen::Vector2i one = cellOnFace(laid, {0, 0});
  const Eigen::Vector2i other = cellOnFace(laid, {1, 1});
  const Eigen::Vector2i origin = one.cwiseMin(other);
  const bool same = ((origin - dark).sum() & 1) == 0;
  return same == lattice.origin_dark ? 1.0 : -1.0;
}

}  // namespace gyre
