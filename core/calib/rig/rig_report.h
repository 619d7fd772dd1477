// From the solved state to what is handed out: the house's frames, the report, the found target.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/calib/rig/rig_bundle.h"
#include "core/calib/rig/rig_problem.h"

namespace gyre {

// Turns and shifts the table frame along its axis to where the house wants it: x towards the camera
// at angle 0, z = 0 where the plane on which the target (or its loose markers) stands meets the
// axis. Changes nothing that can be seen. Gives pictures that show nothing the likeliest angle.
void settleFrames(const RigScene& scene, TargetShape shape, RigState& state);

// A state whose frames are settled, with all that belongs to it.
struct SolvedRig {
  const RigScene& scene;
  const RigState& state;
  const RigCovariance& covariance;
};
// Everything that is handed out.
RigCalibration resultOf(std::span<const TargetView> views, const Target& target,
                        const RigBundleOptions& options, const SolvedRig& solved);

}  // namespace gyre
