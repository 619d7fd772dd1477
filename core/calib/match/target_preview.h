// What a live picture shows of the target, fast enough to be drawn over the preview.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/task.h"
#include "core/calib/match/find_target.h"
#include "core/scan/target_sight.h"

namespace gyre {

// As findTarget(), on a picture reduced to at most 800 px: points are good to about half a pixel,
// which is what an overlay needs. A face passes with half of its points, the target with one such
// face; a ring of markers, which has no faces, whenever it is found.
TargetSight previewTarget(const cv::Mat& image, const Target& target,
                          const FindTargetOptions& options = {}, const Task& task = {});

}  // namespace gyre
