// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/io/atomic_file.h"

namespace gyre {
namespace {

using nlohmann::ordered_json;

ordered_json numberOrNull(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? ordered_json(*number) : ordered_json();
}

// A view that nobody could judge has no px.
ordered_json driftViewsJson(const std::vector<ViewDrift>& views) {
  ordered_json list = ordered_json::array();
  for (const ViewDrift& each : views) {
    ordered_json view;
    view["view"] = each.view;
    view["px"] = each.judged ? ordered_json(each.px) : ordered_json();
    view["sigma_px"] = each.judged ? ordered_json(each.sigma_px) : ordered_json();
    view["moved"] = each.moved;
    list.push_back(std::move(view));
  }
  return list;
}

// {sentence, views: [{view, px, sigma_px, moved}], platter: likewise, where it has a ring}
ordered_json driftJson(const DriftReport& drift) {
  ordered_json root;
  root["sentence"] = drift.sentence;
  root["views"] = driftViewsJson(drift.views);
  if (!drift.platter.empty()) root["platter"] = driftViewsJson(drift.platter);
  return root;
}

// {sentence, rms_off_deg, worst_off_deg, views: [{view, told_deg, angle_deg, sigma_deg}]}; a view
// whose angle the markers did not tell has no sigma.
ordered_json turningJson(const TurningReport& turning) {
  ordered_json root;
  root["sentence"] = turning.sentence;
  root["rms_off_deg"] = degFromRad(turning.rms_off_rad);
  root["worst_off_deg"] = degFromRad(turning.worst_off_rad);
  root["views"] = ordered_json::array();
  for (const TurnedView& each : turning.views) {
    ordered_json view;
    view["view"] = each.view;
    view["told_deg"] = degFromRad(each.told_rad);
    view["angle_deg"] = degFromRad(each.angle_rad);
    view["sigma_deg"] = each.seen ? ordered_json(degFromRad(each.sigma_rad)) : ordered_json();
    root["views"].push_back(std::move(view));
  }
  return root;
}

}  // namespace

std::optional<SigmaPercentiles> sigmaPercentiles(const PointCloud& cloud) {
  if (cloud.points.empty()) return std::nullopt;
  std::vector<double> sigmas_mm;
  sigmas_mm.reserve(cloud.points.size());
  for (const Point& point : cloud.points) sigmas_mm.push_back(point.sigmaMm());
  std::sort(sigmas_mm.begin(), sigmas_mm.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(sigmas_mm.size() - 1);
    return sigmas_mm[static_cast<std::size_t>(std::lround(place))];
  };
  return SigmaPercentiles{at(0.05), at(0.50), at(0.95)};
}

std::string reportJson(const Report& report) {
  ordered_json root;
  root["title"] = report.title;
  root["inventory_number"] = report.inventory_number;
  root["rights"] = report.rights;
  root["date"] = report.date;
  root["size_known"] = report.size_known;
  root["points"] = report.points;
  root["observations"] = report.observations;
  root["rms_px"] = numberOrNull(report.rms_px);
  root["median_px"] = numberOrNull(report.median_px);
  root["calibration_error_mm"] = numberOrNull(report.ray_distance_mm);
  root["closure_px"] = numberOrNull(report.closure_px);
  root["closure_mm"] = numberOrNull(report.closure_mm);
  root["drift"] = report.drift.views.empty() ? ordered_json() : driftJson(report.drift);
  root["turning"] = report.turning ? turningJson(*report.turning) : ordered_json();
  root["seconds"] = ordered_json::object();
  for (const auto& [stage, seconds] : report.seconds) root["seconds"][stage] = seconds;
  const auto& sigma = report.sigma_mm;
  root["sigma_mm"]["p05"] = sigma ? numberOrNull(sigma->p05_mm) : ordered_json();
  root["sigma_mm"]["p50"] = sigma ? numberOrNull(sigma->p50_mm) : ordered_json();
  root["sigma_mm"]["p95"] = sigma ? numberOrNull(sigma->p95_mm) : ordered_json();
  root["versions"] = report.versions;
  root["options"] = report.options;
  root["inputs"] = report.inputs;
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<void> writeReport(const std::filesystem::path& folder, const Report& report) {
  return writeFileAtomically(folder / "report.json", reportJson(report));
}

}  // namespace gyre
