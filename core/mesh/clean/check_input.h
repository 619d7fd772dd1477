// What every step of cleaning up asks of its input.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

// Fails in words without a triangle, on a coordinate or sigma that is no finite number, and on a
// triangle that names a vertex that does not exist.
Result<void> checkMesh(const Mesh& mesh);

// The same, and fails where triangles with fewer than three corners, edges with more than two
// triangles, vertices with more than one fan, or neighbours that disagree about outside remain.
Result<void> checkSurface(const Mesh& mesh);

}  // namespace gyre
