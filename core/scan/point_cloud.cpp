// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/point_cloud.h"

#include <cmath>

namespace gyre {

double Point::sigmaMm() const { return std::sqrt(covariance.trace()); }

void Bounds::include(const Eigen::Vector3d& position) {
  min = min.cwiseMin(position);
  max = max.cwiseMax(position);
}

Bounds boundsOf(const PointCloud& cloud) {
  Bounds bounds;
  for (const Point& point : cloud.points) bounds.include(point.position);
  return bounds;
}

}  // namespace gyre
