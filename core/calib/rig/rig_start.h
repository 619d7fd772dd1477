// A first guess of camera, axis, angles and target, good enough for the bundle to start from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/rig/rig_bundle.h"
#include "core/calib/rig/rig_problem.h"

namespace gyre {

// The focal length is the one with which poses of the target explain single pictures best, the
// axis is linear in the poses, directions and step scale come from the angles the poses show.
// Fails when too few pictures show enough of the target or when they do not turn about one axis.
Result<RigState> startOf(std::span<const TargetView> views, const Target& target,
                         const RigScene& scene, const RigBundleOptions& options, const Task& task);

}  // namespace gyre
