// Reads and writes measurements.json: the lengths that were measured on a model.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scan/measurement.h"

namespace gyre {

// More are kept in no file, and read from none.
inline constexpr std::size_t kMostMeasurements = 10'000;

// {"format": "gyre-measurements", "version": 1, "measurements": [{from_mm [x, y, z], to_mm,
// length_mm, sigma_mm, points_sigma_mm, scale_sigma_mm, size, caliper_mm, note, date}]}: table
// frame, what is unknown null; size is "unknown", "arbitrary", "not verified" or "verified".
// sigma_mm follows from the two beside it; where a file tells only sigma_mm, it counts as the
// points'. Fails in a sentence on anything malformed; a folder's file that is not there: kNotFound.
Result<std::vector<Measurement>> readMeasurements(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<std::vector<Measurement>> parseMeasurements(std::string_view text, const std::string& file);

// The file's text; reading it gives the same numbers to the last bit.
std::string measurementsText(const std::vector<Measurement>& measurements);

// Replaces the file atomically. Refuses what readMeasurements() would refuse.
Result<void> writeMeasurements(const std::filesystem::path& file,
                               const std::vector<Measurement>& measurements);

// Adds one at the end of measurements.json in the folder. A file that is there and cannot be read
// stays as it is, and the call fails.
Result<void> addMeasurement(const std::filesystem::path& folder, const Measurement& measurement);

}  // namespace gyre
