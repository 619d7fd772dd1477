// Closes small gaps in a mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/scan/mesh.h"

namespace gyre {

struct HoleLimits {
  std::size_t max_edges = 24;     // longer rims stay open; time grows with the cube. 3..100
  double max_perimeter_mm = 0.0;  // wider holes stay open
};

// Spans each rim within the limits with triangles between its own vertices, the ones of least area
// in sum, oriented like the mesh around. The mesh is edge-manifold and oriented, and stays so: a
// rim that could only be closed along an edge that exists already stays open. Returns how many rims
// were closed.
std::size_t closeSmallHoles(Mesh& mesh, const HoleLimits& limits);

}  // namespace gyre
