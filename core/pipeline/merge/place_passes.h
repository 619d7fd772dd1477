// Finds how several passes over one object lie on each other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/merge/pass_input.h"
#include "core/scan/scan_pass.h"

namespace gyre {

// Of each pass, in their order; the first one's table frame is the merged one. A pass is laid on
// the one, among those that have a place, with which most spots of its surface agree (pairSpots,
// agreeingMotion), and then fitted to it (fitSurfaces).
// Fails with the pass's name when no spots agree, when hardly anything of it overlaps, or when its
// points lie where others saw through: then it is another object, or one that changed its shape.
Result<std::vector<ScanPass>> placePasses(const std::vector<PassInput>& passes, const Task& task);

}  // namespace gyre
