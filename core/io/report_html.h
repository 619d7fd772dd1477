// report.html: what is to be known of a result, on a page for people.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/report.h"
#include "core/scan/calibration_record.h"
#include "core/scan/measurement.h"
#include "core/scan/mesh_health.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct InlinePicture {
  std::string caption;
  std::string mime;  // "image/png"
  std::string bytes;
};

// What is unknown stays empty, and the page says so where it matters.
struct ReportFacts {
  Report report;
  std::optional<CalibrationRecord> calibration;  // as used
  std::optional<MeshHealth> health;              // nothing without a surface
  Bounds bounds;                                 // of the surface, or of the points
  std::vector<Measurement> measurements;
  std::vector<InlinePicture> pictures;
  std::vector<std::string> doubts;  // what went wrong while the page was made, a sentence each
};

// One page, printable on A4, that loads nothing from elsewhere and runs nothing.
std::string reportHtml(const ReportFacts& facts);

// Width, depth and height with their ±: of the calibration's size, and of the two points of
// middling certainty that bound them. "unknown" without points.
std::string sizeText(const ReportFacts& facts);

// Whether it is closed, in how many pieces, how large; a sentence or two.
std::string healthText(const MeshHealth& health);

// "+/=" and the rest: bytes as they stand in a data: address.
std::string base64(std::string_view bytes);

}  // namespace gyre
