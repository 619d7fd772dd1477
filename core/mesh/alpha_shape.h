// Makes a mesh of a cloud: the outer surface of its 3D alpha shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/options.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct AlphaShapeMesh {
  Mesh mesh;
  double alpha_mm = 0.0;    // as used
  double spacing_mm = 0.0;  // that the points were thinned to
};

// Thins the points to an even spacing, moves each onto the smooth surface its neighbours suggest,
// and keeps the outer facets of the alpha shape whose side agrees with the points' normals, as an
// edge-manifold mesh with outward triangles. Colour, sigma and number of views are those of the
// points; normals are the mesh's. Unseen sides stay open. Clouds without normals get them first.
// Fails in words when the points are too few, coincide, lie in a plane, or are no numbers.
Result<AlphaShapeMesh> alphaShapeMesh(const PointCloud& cloud, const AlphaShapeOptions& options,
                                      const Task& task);

}  // namespace gyre
