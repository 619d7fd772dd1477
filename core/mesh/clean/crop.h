// Cuts off what lies outside a cylinder about the table's axis or beyond planes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct CroppedMesh {
  Mesh mesh;  // may be empty
  std::size_t triangles_removed = 0;
  std::size_t triangles_cut = 0;  // of which a part stayed, counted at each limit
};

// Triangles are cut where they cross: the new vertices lie on the plane or the cylinder, with
// attributes blended along the edge, and what lay inside is unchanged to its last tenth of a
// millimetre. On the cylinder the rim runs straight from one new vertex to the next. A triangle in
// the plane of a limit stays. The rim is open. Fails in words on a mesh that checkMesh refuses,
// when a lower limit is not below its upper one, and when stopped.
Result<CroppedMesh> cropMesh(const Mesh& mesh, const CropOptions& options, const Task& task);

}  // namespace gyre
