// Fills holes with surface that goes on as it does around them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct FilledMesh {
  Mesh mesh;
  std::size_t holes_filled = 0;
  std::size_t holes_left = 0;  // wider, spared, or without a filling that stays manifold
  double filled_mm2 = 0.0;
};

// Each hole within the limits gets triangles as small as those around it, bent to meet the surface
// without a crease; where a filling comes to cross something it is bent less, or not at all. The
// new vertices are unseen, and so is every new triangle; their colour comes from the rim. What was
// there stays, in its order. The outer rim of an open sheet is a hole too. Fails in words on a mesh
// that checkSurface refuses, and when stopped. Liepa, "Filling holes in meshes" (2003), by CGAL.
Result<FilledMesh> fillHoles(const Mesh& mesh, const FillHolesOptions& options, const Task& task);

}  // namespace gyre
