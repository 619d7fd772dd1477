// Makes the triangles of a mesh even.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct RemeshedMesh {
  Mesh mesh;
  double mean_edge_mm = 0.0;
};

// Splits, joins and flips edges until they are near the wanted length, and lays every vertex onto
// the surface before, from which it takes its attributes. Rims and edges sharper than the option
// stay where they are. Fails in words on a mesh that checkSurface refuses, when so short edges
// would make more than ten million triangles, and when stopped. Botsch and Kobbelt, "A remeshing
// approach to multiresolution modeling" (2004), by CGAL.
Result<RemeshedMesh> remeshEvenly(const Mesh& mesh, const RemeshOptions& options, const Task& task);

}  // namespace gyre
