// A table whose angle was lost counts from where it stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/device/turntable.h"

namespace gyre {

// Motors are let go of after a scan, and the angle with them: what begins next begins here, at the
// angle 0. Where the angle is known nothing changes. Moves nothing.
Result<void> countAnewIfLost(Turntable& table);

}  // namespace gyre
