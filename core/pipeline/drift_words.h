// What background and platter say together of bumps.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/drift.h"

namespace gyre {

// Adds what the ring of markers saw, by view, to what the background saw, and makes one sentence of
// both: a camera that was knocked moves both; a table that was pushed moves the platter alone.
void addPlatter(DriftReport& report, const std::vector<ViewDrift>& platter);

}  // namespace gyre
