// How a calibration tells what it found, and its end.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/console.h"
#include "core/pipeline/calibrate.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// "Told to turn by 0.4°, the table turned by 0.8°."
std::string turningText(double told_rad, double turned_rad);

// "003.png: 96 points of the target." or why there are none.
std::string pictureText(const SightedPicture& picture);

// Pictures left out, and what was noticed about the table.
void tellOutcome(Console& console, const CalibrationOutcome& outcome);

// The verdict, its sentence and its two figures.
void tellVerdict(Console& console, const CalibrationReport& report);

// Writes the file, says the verdict with its two figures, and gives the exit code: kFailed, with
// the file written and marked, when it is to be done again.
int endCalibration(Console& console, const std::filesystem::path& file,
                   const CalibrationRecord& record);

}  // namespace gyre
