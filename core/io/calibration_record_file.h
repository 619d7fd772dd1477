// Reads and writes all of calibration.json: beside the calibration, how it came about.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// Fails where readCalibration() does. What stands beside the calibration and is not as this program
// writes it is passed over: files of other programs, and older ones, give less.
Result<CalibrationRecord> readCalibrationRecord(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<CalibrationRecord> parseCalibrationRecord(std::string_view text, const std::string& file);

// The file's text; reading it gives the same record to the last bit, less residuals that are not
// finite. The calibration itself stands first, as readCalibration() takes it.
std::string calibrationRecordText(const CalibrationRecord& record);

// Replaces the file atomically. Refuses a record that readCalibrationRecord() would refuse.
Result<void> writeCalibrationRecord(const std::filesystem::path& file,
                                    const CalibrationRecord& record);

}  // namespace gyre
