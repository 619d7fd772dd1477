// Makes one vertex of those that lie in the same place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct MergedMesh {
  Mesh mesh;
  std::size_t vertices_merged = 0;    // into an earlier one
  std::size_t triangles_removed = 0;  // that lost a corner, or were there twice
};

// The first of the vertices that lie together stays, with its attributes. Vertices that no triangle
// uses are left out. Fails in words on a mesh that checkMesh refuses, and when stopped.
Result<MergedMesh> mergeVertices(const Mesh& mesh, const MergeOptions& options, const Task& task);

}  // namespace gyre
