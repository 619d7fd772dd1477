// What lines of sight say about the cells of a triangulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/max_flow.h"
#include "core/mesh/options.h"
#include "core/mesh/sight_evidence.h"
#include "core/mesh/surface_points.h"
#include "core/mesh/tetrahedra.h"

namespace gyre {

// The graph whose cheapest cut (minimumCut) has the outside of the object on the source's side. Its
// nodes are the cells of the Delaunay triangulation of the points.
//
// A line of sight from a camera to a point of n views, with a = 1 - exp(-n^2 / 18): to stand solid
// before what lies outside costs a (1 - exp(-d^2 / 2 t^2)) at each facet that it passes at the
// distance d before the point, t being the tolerance with which the point and its neighbours stand
// for the surface; to leave the cell at t behind the point outside costs a times the cosine between
// the line and the point's normal. The background of a picture costs 4 at every facet where its
// rays come from outside into what is solid. Beside these a facet costs quality times 1 - cos of
// the flatter angle at which the balls of its cells meet it. Cells that reach infinity are outside.
//
// Fails when the task is stopped. After Labatut et al. (2009), eq. 4 to 6.
Result<CellGraph> freeSpaceGraph(const Tetrahedra& tetrahedra, const SurfacePoints& points,
                                 const SightEvidence& evidence, const VisibilityCutOptions& options,
                                 const Task& task);

}  // namespace gyre
