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

// The turntable as a scan that was begun on it knows it: the angle at which it stands is then 0.
Result<void> matchTurning(const Rig& rig, double units_per_turn, int direction);

// One picture: a ring of markers that the rig was calibrated with and that is still on the platter
// tells of camera and table; without one, the picture that was taken while it was calibrated tells
// of the camera. Gives a sentence when something has moved, and an empty text when nothing has, or
// when nothing can be said.
Result<std::string> lookBeforeScan(const Rig& rig, const CalibrationRecord& record,
                                   const std::filesystem::path& reference, const Task& task);

// Both, before anything is moved. Gives what the user should know, a sentence each.
Result<std::vector<std::string>> prepareRig(const Rig& rig, const CalibrationRecord& record,
                                            const std::filesystem::path& reference,
                                            const Task& task);

}  // namespace gyre
