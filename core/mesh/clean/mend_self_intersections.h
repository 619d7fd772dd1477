// Takes away the places where a mesh passes through itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

struct MendedMesh {
  Mesh mesh;
  std::size_t pairs_before = 0;  // of triangles, as findSelfIntersections counts them
  std::size_t pairs_left = 0;
};

// Around each such place a few triangles are smoothed or laid anew; the rest stays as it is. What
// moved or is new was not seen, triangles between old vertices too, and takes the colour of the
// nearest vertex there was. Closed stays
// closed, and of the same genus and components: where no attempt keeps this with fewer pairs the
// mesh comes back as it was. The mesh has passed checkSurface. Fails in words where it has not, and
// when stopped.
Result<MendedMesh> mendSelfIntersections(const Mesh& mesh, const Task& task);

}  // namespace gyre
