// Draws a target for people, and chooses the corners by which they can show where it is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/target.h"
#include "core/scan/target_sketch.h"

namespace gyre {

// Seen from 35 deg above the table, half way between the target's x and y axes. The corners to
// click are spread over the three faces that are seen best, two on each, or over fewer; there are
// none when fewer than six corners on at least two faces are seen. Faces
// whose corners are not in rows and columns are left out: they could not be followed later.
TargetSketch sketchOf(const Target& target);

}  // namespace gyre
