// Brings a rig to what its calibration knows of it, and looks whether it still holds.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/rig.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// Corrects the turntable by the record, when it is the same device and axis: the angle at which it
// stands is then 0. Refuses, with the reason, a camera that is set otherwise than it was
// calibrated. Moves nothing. Gives what the user should know, a sentence each.
Result<std::vector<std::string>> applyCalibration(const Rig& rig, const CalibrationRecord& record);

// One picture against the one that was taken while the rig was calibrated. Gives a sentence when
// the camera has moved, and an empty text when it has not, or when nothing can be said.
Result<std::string> lookBeforeScan(const Rig& rig, const std::filesystem::path& reference,
                                   const Task& task);

}  // namespace gyre
