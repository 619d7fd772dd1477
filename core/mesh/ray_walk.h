// Follows a straight line from cell to cell of a triangulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "core/geometry/ray.h"
#include "core/mesh/tetrahedra.h"

namespace gyre {

// Where a line leaves a cell.
struct CellExit {
  int side = -1;
  double distance_mm = std::numeric_limits<double>::infinity();  // from the ray's origin
};

// Where the ray, which runs through the finite cell, leaves it; not through the side it came in by
// (-1: it starts inside or at a corner). Always one of the sides, also for flat cells.
CellExit exitOf(const Tetrahedra& tetrahedra, std::uint32_t cell, const Ray& ray, int entry);

// The finite cell at the point into which the ray from there leads; nothing when it leads out of
// the hull at once.
std::optional<std::uint32_t> cellTowards(const Tetrahedra& tetrahedra, const CellsAround& around,
                                         std::uint32_t point, const Eigen::Vector3d& direction);

// Walks from the finite cell in which the ray starts until its length is spent or it reaches an
// infinite cell; calls visit(cell, exit) at each side that is passed. Returns the cell in which it
// ends.
template <class Visit>
std::uint32_t walkCells(const Tetrahedra& tetrahedra, std::uint32_t start, const Ray& ray,
                        double length_mm, const Visit& visit) {
  std::uint32_t cell = start;
  int entry = -1;
  // Rounding may lead a walk among flat cells in circles; no line passes a cell twice.
  for (std::size_t steps = 0; steps < tetrahedra.cells() && !tetrahedra.isInfinite(cell); ++steps) {
    const CellExit exit = exitOf(tetrahedra, cell, ray, entry);
    if (exit.distance_mm >= length_mm) break;
    visit(cell, exit);
    const auto side = static_cast<std::size_t>(exit.side);
    entry = static_cast<int>(tetrahedra.mirrors[cell][side]);
    cell = tetrahedra.neighbours[cell][side];
  }
  return cell;
}

}  // namespace gyre
