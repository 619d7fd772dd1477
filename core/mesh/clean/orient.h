// Turns the triangles of a mesh so that all agree on which side is outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

struct OrientedMesh {
  Mesh mesh;
  std::size_t triangles_turned = 0;
  std::size_t vertices_added = 0;     // where a one-sided surface was cut
  std::size_t triangles_removed = 0;  // that no cut could separate
};

// Neighbours come to agree; then closed pieces are turned with their outside outwards, or inwards
// where they lie within another closed piece and so bound a hollow; open pieces as most of their
// area was. One-sided surfaces are cut. Edges have at most two triangles (splitNonManifold). Fails
// in words on a mesh that checkMesh refuses, and when stopped.
Result<OrientedMesh> orientOutwards(const Mesh& mesh, const Task& task);

}  // namespace gyre
