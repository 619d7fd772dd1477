// Makes vertices where a mesh comes nearest to the z axis between its vertices.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/mesh.h"

namespace gyre {

// Afterwards no edge and no triangle whose corners all lie outside the cylinder reaches into it:
// edges that did are split where they come nearest to the axis, triangles where it pierces them.
// The surface stays the same.
void splitDips(Mesh& mesh, double radius_mm);

}  // namespace gyre
