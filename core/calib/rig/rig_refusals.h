// Pictures from which no rig can be calibrated, told apart by what is wrong with them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/result.h"
#include "core/calib/rig/rig_bundle.h"
#include "core/calib/rig/rig_problem.h"

namespace gyre {

// Sightings of points the target has not, numbers that are none, fewer than two pictures.
Result<void> checkViews(std::span<const TargetView> views, const Target& target,
                        const RigBundleOptions& options);

// The arc that the angles cover together, [0, 2 pi): a full turn less the widest gap.
double coveredArc(const std::vector<double>& angles_rad);

// Too few different angles, or too small an arc.
Result<void> checkArc(const RigScene& scene, const RigState& state,
                      const RigBundleOptions& options);

// All that was seen lies in one plane at right angles to the axis, while intrinsics are free: all
// pictures then share one vanishing line, which leaves the camera undetermined.
Result<void> checkNotFlat(const RigScene& scene, const RigState& state,
                          const RigBundleOptions& options);

// Half of the sightings are further off than the options allow: this is another target.
Result<void> checkFits(const RigScene& scene, const RigState& state,
                       const RigBundleOptions& options, const std::string& target_name);

// The error of pictures that show something else.
Error anotherTarget(const std::string& target_name, double median_px);

}  // namespace gyre
