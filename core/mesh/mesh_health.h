// Examines a mesh: is it closed, is it manifold, how large is it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"

namespace gyre {

// Counts, genus, area and signed volume (sum of the tetrahedra from the origin to each triangle;
// positive when triangles are counter-clockwise from outside). Components are joined by shared
// edges; vertices without a triangle do not count. Triangle indices are in range.
MeshHealth meshHealth(const Mesh& mesh);

}  // namespace gyre
