// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report_reader.h"

#include <cmath>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/io/calibration_record_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMaxBytes = 64U << 20U;
constexpr double kMostCounted = 1e15;

const json& memberOf(const json& object, const char* key) {
  static const json kNull;
  if (object.is_object() && object.contains(key)) return object.at(key);
  return kNull;
}

std::string textOf(const json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::optional<double> numberOf(const json& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::size_t countOf(const json& value) {
  const double number = numberOf(value).value_or(0.0);
  return number >= 0.0 && number <= kMostCounted ? static_cast<std::size_t>(number) : 0;
}

std::map<std::string, std::string> textsOf(const json& value) {
  std::map<std::string, std::string> texts;
  if (!value.is_object()) return texts;
  for (const auto& [name, text] : value.items()) {
    if (text.is_string()) texts[name] = text.get<std::string>();
  }
  return texts;
}

void readFigures(const json& root, Report& report) {
  report.observations = countOf(memberOf(root, "observations"));
  report.rms_px = numberOf(memberOf(root, "rms_px")).value_or(0.0);
  report.median_px = numberOf(memberOf(root, "median_px")).value_or(0.0);
  report.ray_distance_mm = numberOf(memberOf(root, "calibration_error_mm")).value_or(0.0);
  report.closure_px = numberOf(memberOf(root, "closure_px"));
  report.closure_mm = numberOf(memberOf(root, "closure_mm"));
  const json& sigma = memberOf(root, "sigma_mm");
  const auto p05 = numberOf(memberOf(sigma, "p05"));
  const auto p50 = numberOf(memberOf(sigma, "p50"));
  const auto p95 = numberOf(memberOf(sigma, "p95"));
  if (p05 && p50 && p95) report.sigma_mm = SigmaPercentiles{*p05, *p50, *p95};
  const json& seconds = memberOf(root, "seconds");
  if (!seconds.is_object()) return;
  for (const auto& [stage, value] : seconds.items()) {
    if (const auto number = numberOf(value)) report.seconds[stage] = *number;
  }
}

}  // namespace

Result<Report> parseReport(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text);
  if (!memberOf(root, "points").is_number()) {
    return Error{Error::Code::kInvalidInput,
                 "The file \"" + file + "\" is no report of Gyre: it has no number of \"points\".",
                 "Make the result again, or name its folder."};
  }
  Report report;
  report.title = textOf(memberOf(root, "title"));
  report.inventory_number = textOf(memberOf(root, "inventory_number"));
  report.rights = textOf(memberOf(root, "rights"));
  report.date = textOf(memberOf(root, "date"));
  report.size_known = memberOf(root, "size_known") != false;
  report.points = countOf(memberOf(root, "points"));
  readFigures(root, report);
  report.drift.sentence = textOf(memberOf(memberOf(root, "drift"), "sentence"));
  if (const json& turning = memberOf(root, "turning"); turning.is_object()) {
    report.turning.emplace();
    report.turning->sentence = textOf(memberOf(turning, "sentence"));
  }
  report.versions = textsOf(memberOf(root, "versions"));
  report.options = textsOf(memberOf(root, "options"));
  report.inputs = textsOf(memberOf(root, "inputs"));
  return report;
}

Result<Report> readReport(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseReport(*text, file.string());
}

ModelScale scaleOfResult(const std::filesystem::path& folder) {
  const auto report = readReport(folder / "report.json");
  const bool arbitrary = report && !report->size_known;
  const SizeTrust otherwise = arbitrary ? SizeTrust::kArbitrary : SizeTrust::kUnknown;
  const auto record = readCalibrationRecord(folder / "calibration.json");
  return record ? scaleOf(*record, otherwise) : ModelScale{otherwise, std::nullopt};
}

}  // namespace gyre
