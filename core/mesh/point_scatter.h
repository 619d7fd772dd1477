// By how much the points of a cloud disagree about the surface they lie on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/point_cloud.h"

namespace gyre {

struct ScatterReach {
  double apart_mm = 0.0;  // points nearer to each other than that err alike: only one is asked
  double most_mm = 0.0;   // points further away tell of the object's shape instead
};

// For each point the standard deviation of points around it about the surface through them, along
// its normal; 0 where points do not tell. Detail of the surface that no quadric follows counts in.
// The cloud must have its normals. [mm], the same for any number of threads.
std::vector<double> pointScatter(const PointCloud& cloud, const ScatterReach& reach);

}  // namespace gyre
