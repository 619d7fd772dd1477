// What the views' drifts say together, in words for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/scan/drift.h"

namespace gyre {

// One or two sentences: when it began, whether it came back, and what to do; or that nothing moved
// by least_px; or that nothing can be said. Views are counted from 1, as progress counts them.
std::string driftSentence(const std::vector<ViewDrift>& views, double least_px);

}  // namespace gyre
