// Divides space into inside and outside by what the cameras saw through, and returns the wall.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/options.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct VisibilityCutMesh {
  Mesh mesh;
  double spacing_mm = 0.0;  // median, of the points that the surface goes through
};

// A closed mesh, every edge with two triangles, through the points of the cloud: the boundary of
// the set of Delaunay cells that costs least when each line of sight that is taken for solid costs,
// and so does each missing wall behind a point. Points are settled and thinned first (thinPoints).
// Cells that no line of sight tells anything about go where small, even triangles make the wall.
//
// Vertices carry colour, sigma and views of their points. Fails in words when the points are too
// few, no point knows its views, or nothing solid is left. Any thread; the same for any number of
// threads. Labatut, Pons and Keriven, "Robust and efficient surface reconstruction from range data"
// (2009).
Result<VisibilityCutMesh> visibilityCut(const PointCloud& cloud, const SightEvidence& evidence,
                                        const VisibilityCutOptions& options, const Task& task);

}  // namespace gyre
