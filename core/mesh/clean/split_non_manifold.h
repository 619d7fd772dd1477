// Gives surfaces that touch in a vertex or an edge vertices of their own.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/vertex_fans.h"
#include "core/scan/mesh.h"

namespace gyre {

struct SplitMesh {
  Mesh mesh;
  std::size_t vertices_added = 0;     // copies, in the same place
  std::size_t triangles_removed = 0;  // that no copy could separate
};

// Afterwards every edge has at most two triangles and every vertex one fan. Where more than two
// triangles meet at an edge, those stay joined that enclose body between them, so bodies that touch
// in an edge stay closed; what finds no partner gets a rim there. Nothing moves. Fails in words on
// a mesh that checkMesh refuses, and when stopped.
Result<SplitMesh> splitNonManifold(const Mesh& mesh, const Task& task);

// Gives every fan but the first at each vertex a copy of the vertex; returns how many.
std::size_t separateFans(Mesh& mesh, const VertexFans& fans);

}  // namespace gyre
