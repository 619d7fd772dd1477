// Finds where a mesh passes through itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"

namespace gyre {

// Pairs of triangles that meet elsewhere than in a shared edge or vertex, ascending. The mesh has
// passed checkSurface. Fails in words where it has not, and when stopped.
Result<std::vector<std::array<std::uint32_t, 2>>> findSelfIntersections(const Mesh& mesh,
                                                                        const Task& task);

// How many such pairs there are. Meshes that are not manifold are separated first, so surfaces that
// only touch count as well. Fails in words on a mesh that checkMesh refuses, and when stopped.
Result<std::size_t> countSelfIntersections(const Mesh& mesh, const Task& task);

// The mesh's health with its self-intersections, where they can be counted. Fails when stopped.
Result<MeshHealth> wholeHealth(const Mesh& mesh, const Task& task);

}  // namespace gyre
