// What is to be known of a result: report.json, for programs. For people: report_html.h.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/scan/drift.h"
#include "core/scan/point_cloud.h"
#include "core/scan/turning.h"

namespace gyre {

// Below which sigma 5 %, 50 % and 95 % of the points lie.
struct SigmaPercentiles {
  double p05_mm = 0.0;
  double p50_mm = 0.0;
  double p95_mm = 0.0;
};

// Nothing for a cloud without points. The nearest point's own sigma, not interpolated.
std::optional<SigmaPercentiles> sigmaPercentiles(const PointCloud& cloud);

// What is unknown is null in the JSON, or empty.
struct Report {
  std::string title;
  std::string inventory_number;
  std::string rights;
  std::string date;        // when it was made, ISO 8601
  bool size_known = true;  // false: nothing told the model's scale
  std::size_t points = 0;
  std::size_t observations = 0;
  double rms_px = 0.0;           // reprojection error of the accepted observations
  double median_px = 0.0;        // likewise
  double ray_distance_mm = 0.0;  // mean, of points from their rays: the paper's calibration error
  std::optional<double> closure_px;  // gap after a full turn
  std::optional<double> closure_mm;
  std::optional<SigmaPercentiles> sigma_mm;
  DriftReport drift;                            // without views when nobody watched
  std::optional<TurningReport> turning;         // where the angles were solved
  std::map<std::string, double> seconds;        // stage -> time spent
  std::map<std::string, std::string> versions;  // program or library -> version
  std::map<std::string, std::string> options;   // name -> value as used
  std::map<std::string, std::string> inputs;    // what -> file, or a fingerprint of it
};

std::string reportJson(const Report& report);

// Writes report.json in the folder, atomically.
Result<void> writeReport(const std::filesystem::path& folder, const Report& report);

}  // namespace gyre
