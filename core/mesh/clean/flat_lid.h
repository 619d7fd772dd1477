// Fills closed lines in a plane with triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre {

using PlaneLoop = std::vector<Eigen::Vector2d>;

struct FlatLid {
  std::vector<Eigen::Vector2d> points;            // no two are the same
  std::vector<std::vector<std::uint32_t>> loops;  // the point of each vertex of each loop
  std::size_t on_loops = 0;                       // so many points come from loops, and come first
  std::vector<Triangle> triangles;                // counter-clockwise seen from above
};

// Triangles between the loops: within one, outside those within it, and so on. Points are laid
// between them, about spacing_mm apart and not nearer to the loops than that share of it, so that
// the triangles are no longer than needed. Nothing when loops cross themselves or each other.
// Constrained Delaunay triangulation, by CGAL. Throws what CGAL throws.
std::optional<FlatLid> fillLoops(const std::vector<PlaneLoop>& loops, double spacing_mm);

}  // namespace gyre
