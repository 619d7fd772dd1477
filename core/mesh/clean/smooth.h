// Averages noise out of a surface, within what each vertex's own accuracy allows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct SmoothedMesh {
  Mesh mesh;
  double median_move_mm = 0.0;
  double largest_move_mm = 0.0;
  double at_bound_share = 0.0;  // of the vertices: would have moved farther than they may
};

// Taubin's two strokes, 0.5 and -0.53, towards the mean of the neighbours, so that the body does
// not shrink. Rims are smoothed along themselves only. After each pair of strokes no vertex is
// farther from its start than its bound. Normals are made anew. The same for any number of threads.
// Fails in words on a mesh that checkMesh refuses, and when stopped. Taubin, "A signal processing
// approach to fair surface design" (1995), eq. 8.
Result<SmoothedMesh> smoothMesh(const Mesh& mesh, const SmoothOptions& options, const Task& task);

}  // namespace gyre
