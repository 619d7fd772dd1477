// Closes the open bottom of a scan by a flat base.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct CappedMesh {
  Mesh mesh;
  std::size_t rims_closed = 0;
  double base_mm2 = 0.0;          // of the flat lid
  double tallest_skirt_mm = 0.0;  // from the highest point of a rim down to the base
};

// What lies below the base is cut off. Of a closed body that does not lie in the base yet the
// facets that no camera saw and that only close it from below, within the tolerance above the base
// (baseFacets), are taken out; where that cannot be closed again the body stays. Then every rim
// that lies wholly between the base and the tolerance above it is led straight down to the base,
// and the lines there are filled by a flat lid that lies exactly in it, rings between an outer and
// an inner rim too. Where the straight way down would make lines cross, they are smoothed until
// they do not. Skirt and lid are unseen, with the colour of the rim. Without such a rim nothing but
// the cut is made. Fails in words on a mesh that checkSurface refuses, where lines still cross, and
// when stopped.
Result<CappedMesh> capBase(const Mesh& mesh, const BaseCapOptions& options, const Task& task);

}  // namespace gyre
