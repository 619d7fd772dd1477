// The Delaunay triangulation of points in space, as flat arrays.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

// Cells fill all of space: outside the points' hull each has one corner at infinity. Where side i
// is spoken of, it is the triangle opposite corner i.
struct Tetrahedra {
  static constexpr std::uint32_t kInfinity = 0xFFFFFFFFU;  // the corner that is no point

  using Cell = std::array<std::uint32_t, 4>;

  std::vector<Eigen::Vector3d> points;               // as given
  std::vector<Cell> corners;                         // of each cell, positively oriented
  std::vector<Cell> neighbours;                      // of each cell, the cell beyond each side
  std::vector<std::array<std::uint8_t, 4>> mirrors;  // of each side, which one it is of that cell

  std::size_t cells() const { return corners.size(); }
  bool isInfinite(std::uint32_t cell) const;
  // Whether a side has the corner at infinity.
  bool isInfinite(std::uint32_t cell, int side) const;
  // The corners of a side, counter-clockwise seen from outside the cell.
  Triangle side(std::uint32_t cell, int side) const;
};

// The Delaunay triangulation, the same for the same points. Of points that coincide one is a corner
// of cells. Fails with fewer than four points or when all lie in a plane, on a coordinate that is
// not finite, and when the task is stopped. Any thread.
Result<Tetrahedra> delaunay(std::vector<Eigen::Vector3d> points, const Task& task);

// For each point the cells around it, ascending.
class CellsAround {
 public:
  explicit CellsAround(const Tetrahedra& tetrahedra);
  std::span<const std::uint32_t> of(std::uint32_t point) const;

 private:
  std::vector<std::uint32_t> begin_;  // of each point's range in cells_, and the end
  std::vector<std::uint32_t> cells_;
};

}  // namespace gyre
