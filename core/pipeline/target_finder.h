// How a target is looked for in a series of pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/calib/match/find_target.h"
#include "core/pipeline/calibrate.h"
#include "core/scan/target.h"

namespace gyre {

// The target with findTarget() as its finder: each picture by itself for coded targets; for others
// the pose and camera of the last find help to name the points of the next picture alike. The
// finder is one series: it is used by one thread. Folders are searched by findTargets().
//
// start: what is known before the first picture, such as a pose that a person has shown
// (targetFromClicks) or the camera.
SoughtTarget soughtTarget(const Target& target, const FindTargetOptions& start = {});

}  // namespace gyre
