// Bends a guessed underside so that it goes on as the surface around it does.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

struct CurvedUnderside {
  Mesh mesh;
  std::size_t vertices = 0;  // placed anew; 0 where the mesh is as it was
  double bent_mm = 0.0;      // how far at most they were moved from the guess
};

// A closed surface is spanned flat where no camera saw the underside. Here the guess gets even
// triangles and the shape of a thin plate that leaves the surface around it without a crease
// (Botsch and Kobbelt, "An intuitive framework for real-time freeform modeling", 2004). It stays
// above the mesh's lowest level, bends less where it would meet other surface, and never crosses
// more than before: where that cannot be had the mesh is returned as it was. What was seen keeps
// its place and its numbers; the topology stays. Fails in words on a mesh that checkSurface
// refuses, and when stopped. Any thread; the same for any number of threads.
Result<CurvedUnderside> curveUnderside(const Mesh& mesh, const Task& task);

}  // namespace gyre
