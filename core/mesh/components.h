// Tells which triangles of a mesh hang together.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

struct MeshComponents {
  std::vector<std::uint32_t> of_triangle;  // component of each triangle, numbered by first triangle
  std::vector<double> area_mm2;            // of each component
};

// Triangles that share an edge are in the same component.
MeshComponents findComponents(const Mesh& mesh);

// Removes the components with less than the share [0, 1] of the largest one's area, then the
// vertices that no triangle uses; the order of what stays is kept.
void removeSmallComponents(Mesh& mesh, double min_share);

// Removes the vertices that no triangle uses; the order of the others is kept.
void removeUnusedVertices(Mesh& mesh);

}  // namespace gyre
