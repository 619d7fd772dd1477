// From sightings to a rig, judged by corners that took no part in its solution.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/calibrate.h"

namespace gyre {

// Solves the rig from all sightings (calibrateRig), and once more without every fifth point of the
// target, which are then measured with that solution: a check in millimetres, and the verdict falls
// with it. Views are kept in the outcome; skipped pictures, remarks and devices are the caller's.
Result<CalibrationOutcome> solveAndCheck(const std::vector<TargetView>& views, const Target& target,
                                         const RigBundleOptions& options, const Task& task);

}  // namespace gyre
