// Makes report.html of what lies in a result's folder.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/report_html.h"

namespace gyre {

// From report.json, and where they are there: the scan's .gyre file, calibration.json, mesh.ply or
// else points.ply, measurements.json, and the first picture of the scan. What is there and cannot
// be read is told on the page. Fails without report.json.
Result<ReportFacts> reportFactsOf(const std::filesystem::path& folder);

// Writes report.html in the folder, atomically: after a reconstruction, and whenever something of
// the above has changed. A tenth of a second for 100 000 triangles. Thread: any.
Result<void> writeReportPage(const std::filesystem::path& folder);

// The same where the folder holds a report.json, else nothing.
Result<void> refreshReportPage(const std::filesystem::path& folder);

}  // namespace gyre
