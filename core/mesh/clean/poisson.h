// A smooth closed surface that follows the points' normals.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/options.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// The level set of the function whose gradient is nearest to the normals, meshed to the points'
// spacing (PoissonOptions): closed, smooth, and where nothing was measured a bulge of its own
// invention. Colour, sigma and views come from the nearest point; vertices farther from every point
// than two spacings get seen = 0. Points settle and are thinned first, as for the other surfaces.
// Fails in words on too few points, where the equations have no solution, and when stopped; a
// stop is heard between the steps and while meshing, not in the solver. The same input gives the
// same surface. Kazhdan, Bolitho and Hoppe, "Poisson surface reconstruction" (2006), by CGAL.
Result<Mesh> poissonMesh(const PointCloud& cloud, const PoissonOptions& options, const Task& task);

}  // namespace gyre
