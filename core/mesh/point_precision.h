// How well a place on a model is known, by the points around it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/kd_tree.h"
#include "core/mesh/surface_index.h"
#include "core/scan/measurement.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// Over points that do not change. Reading is safe from any thread.
class PointPrecision {
 public:
  // By the covariances of measured points.
  explicit PointPrecision(const PointCloud& cloud);

  // By sigma_mm of a mesh's vertices that cameras saw. A sigma does not tell its direction: all of
  // it is taken to lie along whatever is measured, so that the result is never too small, and
  // often too large.
  explicit PointPrecision(const Mesh& mesh);

  // Of the eight nearest points that with the middle trace. One point's own covariance, not a mean
  // that noise would cancel in: neighbours err alike. Nothing when no point is near, by the
  // distances of the nearest ones among each other, or it is not known how well they are known.
  std::optional<Eigen::Matrix3d> covarianceAt(const Eigen::Vector3d& place_in_table) const;

 private:
  KdTree tree_;
  std::vector<Eigen::Matrix3d> covariances_;  // by the tree's index
};

// The place of the surface nearest to a given one; a mesh without triangles gives its nearest
// vertex. surface is the index of mesh.
PickedPoint pickNearest(const Mesh& mesh, const SurfaceIndex& surface,
                        const PointPrecision& precision, const Eigen::Vector3d& place_in_table);

}  // namespace gyre
