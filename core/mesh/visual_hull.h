// The body that an object's outlines leave: the surface for what has no texture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/options.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/mesh.h"

namespace gyre {

struct VisualHullMesh {
  Mesh mesh;             // closed, manifold, oriented outward; the base on the table z = 0
  double cell_mm = 0.0;  // as used
};

// Solid is what lies on the object in every picture that shows it, but for a few that may be wrong
// (options). Hollows that no outline shows are filled: a bowl comes out with a lid. Vertices on the
// table get seen = 0; colours are not set. The lattice's distance to an outline is measured in the
// picture, between pixels, so that the surface is smoother than its pixels. Fails when there are
// fewer than three outlines, when they leave nothing, or when stopped. Thread: any; the same result
// for any number of threads. Laurentini, "The visual hull concept" (1994).
Result<VisualHullMesh> visualHull(const SightEvidence& evidence, const VisualHullOptions& options,
                                  const Task& task);

}  // namespace gyre
