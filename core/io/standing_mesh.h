// A mesh as printers and viewers take it: checked, standing on z = 0, nothing but its surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

// What STL, 3MF and GLB are written from. In the table frame the platter is z = 0, but where no
// camera saw the base a surface ends a little above it, and noise takes it a little below. A
// printer needs it to lie on the bed, and a slicer would move it there anyway: the whole mesh is
// moved along z so that its lowest corner is at 0. Nothing is turned, scaled or moved sideways; a
// mesh whose base lies on the platter is not moved at all. PLY and OBJ stay in the table frame.
//
// Vertices of no triangle are left out, and triangles that name a vertex twice. Every vertex has
// a unit normal: the mesh's own, or where there is none that of its triangles. Fails when nothing
// is left, when a position is no number or beyond 1 km, and when there are more than 40 million
// triangles, which a binary STL file of 2 GB cannot hold.
Result<Mesh> standingMesh(const Mesh& mesh);

}  // namespace gyre
