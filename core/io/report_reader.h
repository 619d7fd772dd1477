// Reads report.json again.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/report.h"
#include "core/scan/measurement.h"

namespace gyre {

// All of report.json but the figures view by view: of drift and turning the sentences alone. What
// is missing or of another kind is taken as unknown: reports of older versions tell less. Fails
// when the file cannot be read, is no JSON or has no "points".
Result<Report> readReport(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<Report> parseReport(std::string_view text, const std::string& file);

// What stands behind the millimetres of the model in a result's folder, by its calibration.json
// and report.json; unknown where neither says.
ModelScale scaleOfResult(const std::filesystem::path& folder);

}  // namespace gyre
