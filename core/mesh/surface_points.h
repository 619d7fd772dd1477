// Makes measured points ready to be joined to a surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct SurfacePoints {
  PointCloud cloud;
  // Each point's square on the surface has this side. [mm]
  std::vector<double> spacing_mm;
};

// Where the points are. [mm]
std::vector<Eigen::Vector3d> positionsOf(const PointCloud& cloud);

// Sets normals where the cloud has none, and lets the points settle on the surface that they
// suggest together (settlePoints). Fails in words when points are too few or no numbers, and when
// stopped.
Result<PointCloud> settledCloud(const PointCloud& cloud, const Task& task);

// Settles the points and thins them, each neighbourhood to its own spacing: a dense side stays
// denser than a sparse one, but no points lie so close that their noise would make folds.
// spacing_mm: at least so far apart, 0 for what noise asks. Fails as settledCloud.
Result<SurfacePoints> surfacePoints(const PointCloud& cloud, double spacing_mm, const Task& task);

// Standard deviation of the point along its normal. [mm]
double sigmaAlongNormal(const Point& point);

// Up to `count` of the views that saw the point, of the first `known` ones, evenly spread over
// their list.
std::vector<std::uint32_t> spreadViews(const Point& point, std::size_t known, std::size_t count);

// A mesh vertex at the point, with its colour, normal, sigma and number of views.
MeshVertex vertexOf(const Point& point);

}  // namespace gyre
