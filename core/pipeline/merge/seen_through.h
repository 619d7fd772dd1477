// Whether points can be part of an object that other cameras saw.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/rigid3.h"
#include "core/pipeline/merge/pass_input.h"

namespace gyre {

// The share of a cloud's points that many cameras of another pass saw through: background is where
// they would be, by the pass's outlines. Near 0 for points of the same object, laid where it lies;
// 0 where the pass keeps no outlines. other_from_cloud: between the table frames. Thread: any.
double seenThroughShare(const PointCloud& cloud, const Rigid3& other_from_cloud,
                        const PassInput& other);

}  // namespace gyre
