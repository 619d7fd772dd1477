// Uses what a calibration measured of a turntable when that turntable is driven again.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/turntable.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// From now on a backward move passes its target by more than this play, and returns. A longer way
// that is set already stays. 0 or less changes nothing; moves nothing. [rad]
void takeUpBacklash(Turntable& turntable, double backlash_rad);

// The record's turntable when it is the same device and axis, else one of which nothing is known:
// with no play and no time to settle.
CalibratedTurntable measuredTurntable(const TurntableInfo& info, const CalibrationRecord& record);

}  // namespace gyre
