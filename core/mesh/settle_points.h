// Brings noisy points to rest on the smooth surface that they suggest together.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/kd_tree.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// The points that lie on their neighbours' surface, moved onto it: along its normal, but no farther
// than a few of their own sigmas explain (a quarter of the local spacing where sigma is 0). Points
// far off the surface of the neighbours on their side of the object, by their sigma and by their
// spacing, are left out as outliers. `tree` holds the positions of the cloud, whose normals are
// set; two points whose normals differ by more than 60 degrees do not speak for each other. Fails
// when the task is stopped.
Result<PointCloud> settlePoints(const PointCloud& cloud, const KdTree& tree, const Task& task);

}  // namespace gyre
