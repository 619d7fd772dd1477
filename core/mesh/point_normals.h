// Gives the points of a cloud their normals.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct PointNormalOptions {
  // So many nearest points decide each normal: more is smoother, fewer follows edges. 6..200
  std::size_t neighbours = 16;
  // Where the surface is met more obliquely than this cosine, on average over the cameras that saw
  // it, its side is taken from its neighbours instead. [0, 1)
  double min_facing = 0.1;
  // Neighbours that were seen from another side, by less than this cosine between the directions to
  // the cameras, do not decide the normal: they lie on the far side of a thin wall. [-1, 1)
  double min_shared_view = 0.3;
};

// Sets the normal of every point, unit length in the table frame, from a quadric through its
// neighbours; it looks towards the cameras that saw the point. towards_camera: for each point a
// direction (any length) to the cameras that saw it, the zero vector where that is not known; or
// empty. Points without a direction take their side from their neighbours, the highest point of
// each connected piece looking up and outwards. A point whose neighbours lie on a line keeps a zero
// normal. Fails when the task is stopped; the cloud is then unchanged.
Result<void> setPointNormals(PointCloud& cloud, std::span<const Eigen::Vector3d> towards_camera,
                             const PointNormalOptions& options, const Task& task);

}  // namespace gyre
