// How the surface bends at the points of a cloud.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/scan/point_cloud.h"

namespace gyre {

// For each point the symmetric B by which the surface rises along the point's normal over its
// tangent plane, by d'Bd / 2 at the offset d; zero where the points do not tell. [1/mm], table
// frame. From a quadric through so many nearest points that look the same way (fitLocalSurface).
// The cloud must have its normals. The same for any number of threads.
std::vector<Eigen::Matrix3d> pointBending(const PointCloud& cloud, std::size_t neighbours = 24);

}  // namespace gyre
