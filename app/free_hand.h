// A table that a person turns freely: the ring of markers on its platter tells where it stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "app/rig.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/watched_turntable.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// "hand:free".
bool namesFreeHand(const std::string& turntable_word);

// Puts a table in the rig that is turned freely before its camera and whose angle is 0 where it
// stands. views: in one turn; a picture is taken within a third of the way between two of them.
// tell: says to the person what is still to do. Fails when the calibration knows of no ring on the
// platter, and when the camera does not see it.
Result<void> watchByRing(Rig& rig, const CalibrationRecord& record, int views, TellPerson tell,
                         const Task& task);

}  // namespace gyre
