// What the points around a point tell of the surface there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/scan/point_cloud.h"

namespace gyre {

struct PointSurface {
  // Unit, on the side of the point's own; zero where the points do not tell.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // Symmetric B by which the surface rises along the point's normal over its tangent plane: by
  // d'Bd / 2 at the offset d. [1/mm], table frame
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();
  // How far points around are off that surface, as a standard deviation; the surface's own detail
  // counts in. [mm]
  double scatter_mm = 0.0;
  double reach_mm = 0.0;  // how far away the farthest of these points is
};

// For each point from `first` on a quadric through so many nearest points that look the same way
// (fitLocalSurface); zeros where the points do not tell. The cloud must have its normals. The same
// for any number of threads.
std::vector<PointSurface> pointSurfaces(const PointCloud& cloud, std::size_t first = 0,
                                        std::size_t neighbours = 24);

}  // namespace gyre
