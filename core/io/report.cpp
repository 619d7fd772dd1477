// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/io/atomic_file.h"
#include "core/io/xml_text.h"

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

std::string withUnit(double number, const char* unit) { return formatted("%.3g %s", number, unit); }

void appendRow(std::string& html, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  html.append("<tr><th>").append(xmlText(name)).append("</th><td>").append(xmlText(value));
  html.append("</td></tr>\n");
}

void appendTable(std::string& html, const char* title,
                 const std::map<std::string, std::string>& rows) {
  if (rows.empty()) return;
  html.append("<h2>").append(title).append("</h2>\n<table>\n");
  for (const auto& [name, value] : rows) appendRow(html, name, value);
  html.append("</table>\n");
}

void appendResult(std::string& html, const Report& report) {
  html.append("<table>\n");
  appendRow(html, "Inventory number", report.inventory_number);
  appendRow(html, "Rights", report.rights);
  appendRow(html, "Points", std::to_string(report.points));
  appendRow(html, "Sightings of these points", std::to_string(report.observations));
  if (report.sigma_mm) {
    appendRow(html, "Half of the points are certain to",
              "± " + withUnit(report.sigma_mm->p50_mm, "mm"));
    appendRow(html, "95 % of the points are certain to",
              "± " + withUnit(report.sigma_mm->p95_mm, "mm"));
  }
  appendRow(html, "Points miss their sightings by (median)", withUnit(report.median_px, "px"));
  appendRow(html, "Points miss their sightings by (rms)", withUnit(report.rms_px, "px"));
  appendRow(html, "Points miss their rays by (mean)", withUnit(report.ray_distance_mm, "mm"));
  if (report.closure_px) {
    appendRow(html, "Gap after a full turn", withUnit(*report.closure_px, "px"));
  }
  if (report.closure_mm) {
    appendRow(html, "Gap after a full turn", withUnit(*report.closure_mm, "mm"));
  }
  appendRow(html, "Bumps of camera and table", report.drift.sentence);
  if (!report.size_known) {
    appendRow(html, "Size",
              "unknown: nothing told the scale, millimetres here are arbitrary units");
  }
  if (report.turning) appendRow(html, "How the table turned", report.turning->sentence);
  html.append("</table>\n");
}

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:44em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;width:100%}th{text-align:left;font-weight:normal;color:#666}"
    "th,td{padding:.2em .5em;border-bottom:1px solid #ddd;vertical-align:top}"
    "td{overflow-wrap:anywhere}h2{font-size:1.1em;margin-top:2em}";

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

std::string reportHtml(const Report& report) {
  const std::string title = xmlText(report.title.empty() ? "Scan report" : report.title);
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>";
  html.append(title).append("</title>\n<style>").append(kStyle).append("</style></head>\n<body>");
  html.append("<h1>").append(title).append("</h1>\n");
  appendResult(html, report);
  std::map<std::string, std::string> times;
  for (const auto& [stage, seconds] : report.seconds) times[stage] = withUnit(seconds, "s");
  appendTable(html, "Time spent", times);
  appendTable(html, "Made from", report.inputs);
  appendTable(html, "Options", report.options);
  appendTable(html, "Versions", report.versions);
  return html.append("</body></html>\n");
}

Result<void> writeReport(const std::filesystem::path& folder, const Report& report) {
  if (auto done = writeFileAtomically(folder / "report.json", reportJson(report)); !done) {
    return done;
  }
  return writeFileAtomically(folder / "report.html", reportHtml(report));
}

}  // namespace gyre
