// Lays one measured surface on another of which it shares a part.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// One place of the object in two frames.
struct PlacePair {
  Eigen::Vector3d fixed;  // mm
  Eigen::Vector3d moving;
};

// A surface, and the points it was made through, with normals.
struct MeasuredSurface {
  const Mesh& mesh;
  const PointCloud& cloud;
};

struct SurfaceFit {
  Rigid3 fixed_from_moving;
  double overlap = 0.0;      // share of the moving points that lie on seen fixed surface, [0, 1]
  double residual_mm = 0.0;  // median distance of these from it
};

// The motion that best brings together the seen surfaces where they overlap and the pairs, from a
// start that errs by a percent or two of the size: points of each to the plane of the other's
// nearest triangle, both ways, and pair to pair, each kind weighted by how closely it agrees, all
// robustly (Cauchy). Pairs hold what slides freely otherwise: a bowl on its axis. Chen and Medioni,
// "Object modelling by registration of multiple range images" (1992).
// Fails when hardly anything overlaps, and when the motion stays open.
Result<SurfaceFit> fitSurfaces(const MeasuredSurface& fixed, const MeasuredSurface& moving,
                               std::span<const PlacePair> pairs, const Rigid3& start,
                               const Task& task);

}  // namespace gyre
