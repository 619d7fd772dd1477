// Makes a mesh of fewer triangles that lies close to the one it came from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct DecimatedMesh {
  Mesh mesh;
  double largest_move_mm = 0.0;  // of the new vertices from the surface before
};

// Collapses edges, the one that changes volume and rim least first, until the budget is met or no
// edge can go without folding the surface; volume is kept by the choice of each new vertex. Its
// attributes come from the nearest place of the surface before. Fails in words on a mesh that
// checkSurface refuses, and when stopped. Lindstrom and Turk, "Fast and memory efficient polygonal
// simplification" (1998), by CGAL.
Result<DecimatedMesh> decimateMesh(const Mesh& mesh, const DecimateOptions& options,
                                   const Task& task);

}  // namespace gyre
