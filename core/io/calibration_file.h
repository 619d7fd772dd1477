// Reads and writes calibration.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/calibration.h"

namespace gyre {

// Fails with a sentence on anything that no real calibration holds: numbers that are missing, not
// finite or absurd, a rotation that is none. Unknown keys are passed over.
Result<Calibration> readCalibration(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<Calibration> parseCalibration(std::string_view text, const std::string& file);

// The file's text; reading it gives the same calibration to the last bit.
std::string calibrationText(const Calibration& calibration);

// Replaces the file atomically. Refuses a calibration that readCalibration() would refuse.
Result<void> writeCalibration(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace gyre
