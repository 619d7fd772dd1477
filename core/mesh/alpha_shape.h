// Makes a mesh of a cloud: the outer surface of its 3D alpha shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/alpha_filtration.h"
#include "core/mesh/options.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct AlphaShapeMesh {
  Mesh mesh;
  double alpha_mm = 0.0;    // as used
  double spacing_mm = 0.0;  // that the points were thinned to
};

// The points of a cloud, triangulated once, from which the surface for any alpha is made fast
// enough to follow a slider. Reading is safe from any thread.
class AlphaShape {
 public:
  // Thins the points to an even spacing, moves each onto the smooth surface its neighbours suggest,
  // and triangulates. Clouds without normals get them first. Fails in words when the points are too
  // few, coincide, lie in a plane, or are no numbers, and when stopped.
  static Result<AlphaShape> prepare(const PointCloud& cloud, const AlphaShapeOptions& options,
                                    const Task& task);

  // What alpha is when nobody chooses it. [mm]
  double automaticAlphaMm() const { return automatic_alpha_mm_; }

  // The outer facets of the alpha shape whose side agrees with the points' normals, as an
  // edge-manifold mesh with outward triangles. Colour, sigma and number of views are those of the
  // points; normals are the mesh's. Unseen sides stay open. Fails when no triangle is so small.
  Result<AlphaShapeMesh> at(double alpha_mm) const;

 private:
  AlphaShape(std::vector<MeshVertex> vertices, AlphaFiltration filtration);

  std::vector<MeshVertex> vertices_;
  AlphaFiltration filtration_;
  double spacing_mm_ = 0.0;
  double automatic_alpha_mm_ = 0.0;
  double min_component_share_ = 0.0;
};

// AlphaShape::prepare, then at the options' alpha.
Result<AlphaShapeMesh> alphaShapeMesh(const PointCloud& cloud, const AlphaShapeOptions& options,
                                      const Task& task);

}  // namespace gyre
