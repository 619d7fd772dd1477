// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report_html.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <openssl/evp.h>

#include "core/base/formatted.h"
#include "core/io/xml_text.h"

namespace gyre {
namespace {

constexpr const char* kStyle =
    "@page{size:A4;margin:14mm}"
    "body{font:15px/1.45 sans-serif;max-width:52em;margin:1.5em auto;padding:0 1em;color:#222}"
    "h1{margin:0 0 .1em}h2{font-size:1.05em;margin:1.3em 0 .3em;border-bottom:2px solid #888}"
    "table{border-collapse:collapse;width:100%}"
    "th{text-align:left;font-weight:normal;color:#555;width:38%}"
    "th,td{padding:.15em .5em .15em 0;border-bottom:1px solid #ddd;vertical-align:top}"
    "td{overflow-wrap:anywhere}.lengths th{width:auto;font-weight:bold}"
    ".pictures{display:flex;flex-wrap:wrap;gap:.6em;margin:.8em 0}"
    "figure{margin:0;flex:1 1 8em;max-width:16em}figure img{width:100%;border:1px solid #ddd}"
    "figcaption{font-size:.8em;color:#555}.doubt{border-left:4px solid #b35900;padding-left:.7em}"
    ".small{font-size:.75em;columns:2}.small table{break-inside:auto}"
    "@media print{body{font-size:10pt;margin:0;max-width:none}h2,figure,tr{break-inside:avoid}}";

class Page {
 public:
  void heading(const char* text) { html_.append("<h2>").append(text).append("</h2>\n"); }
  void beginTable(const char* kind = "") { html_.append("<table").append(kind).append(">\n"); }
  void endTable() { html_.append("</table>\n"); }
  // Nothing where there is no value. Both are escaped.
  void row(const std::string& name, const std::string& value) {
    if (value.empty()) return;
    html_.append("<tr><th>").append(xmlText(name)).append("</th><td>").append(xmlText(value));
    html_.append("</td></tr>\n");
  }
  void cells(const std::vector<std::string>& texts, const char* cell) {
    html_.append("<tr>");
    for (const std::string& text : texts) {
      html_.append("<").append(cell).append(">").append(xmlText(text));
      html_.append("</").append(cell).append(">");
    }
    html_.append("</tr>\n");
  }
  void paragraph(const char* kind, const std::string& text) {
    if (text.empty()) return;
    html_.append("<p").append(kind).append(">").append(xmlText(text)).append("</p>\n");
  }
  void raw(const std::string& html) { html_.append(html); }
  std::string take() { return std::move(html_); }

 private:
  std::string html_;
};

std::string withUnit(double number, const char* unit) { return formatted("%.3g %s", number, unit); }

const char* unitOf(const Report& report) { return report.size_known ? "mm" : "units"; }

ModelScale scaleIn(const ReportFacts& facts) {
  const SizeTrust otherwise = facts.report.size_known ? SizeTrust::kUnknown : SizeTrust::kArbitrary;
  return scaleOf(facts.calibration.value_or(CalibrationRecord{}), otherwise);
}

std::string trustText(SizeTrust trust) {
  switch (trust) {
    case SizeTrust::kArbitrary:
      return "Size unknown: nothing told the scale, and millimetres here are arbitrary units.";
    case SizeTrust::kNotVerified:
      return "Size not verified: nobody measured the printed target with a caliper.";
    case SizeTrust::kUnknown:
      return "How true the size is, the calibration does not say.";
    case SizeTrust::kVerified:
      break;
  }
  return {};
}

void addPictures(const ReportFacts& facts, Page& page) {
  if (facts.pictures.empty()) return;
  page.raw("<div class=\"pictures\">\n");
  for (const InlinePicture& each : facts.pictures) {
    const std::string caption = xmlText(each.caption);
    page.raw("<figure><img alt=\"");
    page.raw(caption);
    page.raw("\" src=\"data:" + xmlText(each.mime) + ";base64," + base64(each.bytes));
    page.raw("\"><figcaption>");
    page.raw(caption);
    page.raw("</figcaption></figure>\n");
  }
  page.raw("</div>\n");
}

void addModel(const ReportFacts& facts, Page& page) {
  const Report& report = facts.report;
  const char* unit = unitOf(report);
  page.heading("The model");
  page.beginTable();
  page.row("Width × depth × height", sizeText(facts));
  page.row("Points", std::to_string(report.points) + ", of " + std::to_string(report.observations) +
                         " sightings");
  if (report.sigma_mm) {
    page.row("Half of the points are certain to", "± " + withUnit(report.sigma_mm->p50_mm, unit));
    page.row("95 % of the points are certain to", "± " + withUnit(report.sigma_mm->p95_mm, unit));
  } else {
    page.row("Certainty of the points", "unknown");
  }
  if (const auto& health = facts.health; health && health->area_mm2 > 0.0) {
    const double guessed = 100.0 * health->unseen_area_mm2 / health->area_mm2;
    page.row("Surface seen by a camera", formatted("%.1f %%", 100.0 - guessed));
    page.row("Surface guessed (hatched in the pictures)", formatted("%.1f %%", guessed));
    page.row("Surface", healthText(*health));
  } else {
    page.row("Surface", "none");
  }
  page.endTable();
}

void addScan(const ReportFacts& facts, Page& page) {
  const Report& report = facts.report;
  page.heading("The scan");
  page.beginTable();
  if (report.closure_px || report.closure_mm) {
    std::string gap = report.closure_px ? withUnit(*report.closure_px, "px") : std::string();
    if (report.closure_mm) {
      gap += (gap.empty() ? "" : ", ") + withUnit(*report.closure_mm, unitOf(report));
    }
    page.row("Gap after a full turn", gap);
  } else {
    page.row("Gap after a full turn", "unknown: it takes a whole turn of views to measure it");
  }
  page.row("Points miss their sightings by",
           withUnit(report.median_px, "px (median)") + ", " + withUnit(report.rms_px, "px (rms)"));
  page.row("Points miss their rays by",
           withUnit(report.ray_distance_mm, unitOf(report)) + " (mean)");
  page.row("Bumps of camera and table", report.drift.sentence);
  if (report.turning) page.row("How the table turned", report.turning->sentence);
  page.endTable();
}

const char* verdictText(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return "good";
    case CalibrationVerdict::kAcceptable:
      return "acceptable";
    case CalibrationVerdict::kRedo:
      break;
  }
  return "better calibrate again";
}

void addCalibration(const ReportFacts& facts, Page& page) {
  page.heading("The calibration");
  const std::string doubt = trustText(scaleIn(facts).trust);
  page.paragraph(" class=\"doubt\"", doubt);
  if (!facts.calibration || !facts.calibration->report) {
    page.paragraph("", "Its file holds no verdict: how good the calibration is, is unknown.");
    return;
  }
  const CalibrationRecord& record = *facts.calibration;
  const CalibrationReport& report = *record.report;
  page.beginTable();
  page.row("Verdict", verdictText(report.verdict));
  page.row("In words", report.sentence);
  page.row("Date", record.date.empty() ? "unknown" : record.date);
  page.row("Target", record.target);
  page.row("Expected on an object of " + formatted("%.0f mm", report.object_size_mm),
           formatted("shape ± %.3f mm, overall size ± %.3f mm", report.local_detail_mm,
                     report.overall_size_mm) +
               (report.size_verified ? "" : " (size not verified)"));
  if (report.check_mm > 0.0) {
    page.row("Checked with points that took no part", formatted("%.3f mm", report.check_mm));
  }
  for (const std::string& remark : report.remarks) page.row("Noticed", remark);
  page.endTable();
}

void addMeasurements(const ReportFacts& facts, Page& page) {
  if (facts.measurements.empty()) return;
  page.heading("Measured on the model");
  page.beginTable(" class=\"lengths\"");
  page.cells({"What", "Length", "Caliper", "Difference", "Date"}, "th");
  for (const Measurement& one : facts.measurements) {
    page.cells({one.note, lengthText(one),
                one.caliper_mm ? formatted("%.10g mm", *one.caliper_mm) : std::string("—"),
                one.caliper_mm ? caliperText(one) : std::string("—"), one.date},
               "td");
  }
  page.endTable();
}

void addList(Page& page, const char* title, const std::map<std::string, std::string>& rows) {
  if (rows.empty()) return;
  page.heading(title);
  page.beginTable();
  for (const auto& [name, value] : rows) page.row(name, value);
  page.endTable();
}

void addSmallPrint(const Report& report, Page& page) {
  addList(page, "Made from", report.inputs);
  page.raw("<div class=\"small\">\n");
  addList(page, "Versions", report.versions);
  addList(page, "Options", report.options);
  std::map<std::string, std::string> times;
  for (const auto& [stage, seconds] : report.seconds) times[stage] = withUnit(seconds, "s");
  addList(page, "Time spent", times);
  page.raw("</div>\n");
}

}  // namespace

std::string sizeText(const ReportFacts& facts) {
  if (facts.bounds.empty()) return "unknown";
  const Eigen::Vector3d size_mm = facts.bounds.max - facts.bounds.min;
  const ModelScale scale = scaleIn(facts);
  const char* unit = unitOf(facts.report);
  std::string text =
      formatted("%.2f × %.2f × %.2f %s", size_mm.x(), size_mm.y(), size_mm.z(), unit);
  if (!facts.report.sigma_mm) return text + " (± unknown)";
  // A third of a point's variance lies along each axis, on the whole.
  const double points_mm = facts.report.sigma_mm->p50_mm * std::sqrt(2.0 / 3.0);
  const double scale_mm = scale.sigma_share.value_or(0.0) * size_mm.maxCoeff();
  text += formatted(", ± %.2g %s", std::hypot(points_mm, scale_mm), unit);
  return scale.sigma_share ? text : text + " from the points alone";
}

std::string healthText(const MeshHealth& health) {
  std::string text;
  if (health.closed) {
    text = formatted("Closed, without holes, %.4g cm³", health.volume_mm3 / 1000.0);
  } else {
    text = formatted("Open, with %zu %s", health.holes, health.holes == 1 ? "rim" : "rims");
  }
  text += formatted("; %zu %s, %zu triangles, %.4g cm².", health.components,
                    health.components == 1 ? "piece" : "pieces", health.triangles,
                    health.area_mm2 / 100.0);
  if (health.genus && *health.genus > 0) {
    text += formatted(" %ld %s through it.", *health.genus,
                      *health.genus == 1 ? "tunnel leads" : "tunnels lead");
  }
  const std::size_t touching = health.non_manifold_edges + health.non_manifold_vertices;
  if (touching > 0) {
    text += formatted(" It touches itself at %zu %s: mend that before printing.", touching,
                      touching == 1 ? "place" : "places");
  }
  return text;
}

std::string base64(std::string_view bytes) {
  // The library ends its text with a zero.
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string reportHtml(const ReportFacts& facts) {
  const Report& report = facts.report;
  const std::string title = xmlText(report.title.empty() ? "Scan report" : report.title);
  Page page;
  page.raw("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" + title +
           "</title>\n<style>" + kStyle + "</style></head>\n<body>\n<h1>" + title + "</h1>\n");
  page.beginTable();
  page.row("Inventory number", report.inventory_number);
  page.row("Rights", report.rights);
  page.row("Made", report.date);
  page.endTable();
  for (const std::string& doubt : facts.doubts) page.paragraph(" class=\"doubt\"", doubt);
  addPictures(facts, page);
  addModel(facts, page);
  addMeasurements(facts, page);
  addScan(facts, page);
  addCalibration(facts, page);
  addSmallPrint(report, page);
  page.raw("</body></html>\n");
  return page.take();
}

}  // namespace gyre
