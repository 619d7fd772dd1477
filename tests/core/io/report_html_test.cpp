// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kEvil = "<script>alert('x')</script> \"&";
constexpr const char* kTame = "&lt;script&gt;alert('x')&lt;/script&gt; &quot;&amp;";

ReportFacts sampleFacts() {
  ReportFacts facts;
  facts.report.title = "Duck";
  facts.report.points = 5123;
  facts.report.sigma_mm = SigmaPercentiles{0.01, 0.03, 0.05};
  facts.bounds.include({-10, -20, 0});
  facts.bounds.include({30, 20, 60});
  return facts;
}

ReportFacts calibratedFacts() {
  ReportFacts facts = sampleFacts();
  facts.calibration.emplace();
  facts.calibration->date = "2026-01-01T12:00:00Z";
  CalibrationReport& report = facts.calibration->report.emplace();
  report.verdict = CalibrationVerdict::kAcceptable;
  report.object_size_mm = 80.0;
  report.local_detail_mm = 0.012;
  report.overall_size_mm = 0.04;
  return facts;
}

TEST(ReportHtml, SpeaksToPeopleAndLoadsNothing) {
  ReportFacts facts = calibratedFacts();
  facts.report.closure_px = 0.42;
  facts.report.closure_mm = 0.05;
  facts.pictures = {{"From the front", "image/png", "abc"}};
  const std::string html = reportHtml(facts);
  EXPECT_THAT(html, HasSubstr("± 0.03 mm"));
  EXPECT_THAT(html, HasSubstr("± 0.05 mm"));
  EXPECT_THAT(html, HasSubstr("0.42 px, 0.05 mm"));
  EXPECT_THAT(html, HasSubstr("acceptable"));
  EXPECT_THAT(html, HasSubstr("2026-01-01T12:00:00Z"));
  EXPECT_THAT(html, HasSubstr("Size not verified"));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/png;base64,YWJj\""));
  EXPECT_THAT(html, HasSubstr("size:A4"));
  for (const char* foreign : {"http", "<script", "<link", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(foreign)));
  }
}

TEST(ReportHtml, LetsNobodyWriteIntoThePage) {
  ReportFacts facts = calibratedFacts();
  Report& report = facts.report;
  report.title = report.inventory_number = report.rights = report.date = kEvil;
  report.drift.sentence = kEvil;
  report.turning.emplace();
  report.turning->sentence = kEvil;
  report.options = report.versions = report.inputs = {{kEvil, kEvil}};
  report.seconds = {{kEvil, 1.0}};
  facts.calibration->date = facts.calibration->target = kEvil;
  facts.calibration->report->sentence = kEvil;
  facts.calibration->report->remarks = {kEvil};
  Measurement one;
  one.length_mm = 1.0;
  one.note = one.date = kEvil;
  facts.measurements = {one};
  facts.pictures = {{kEvil, kEvil, "a"}};
  const std::string html = reportHtml(facts);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("x')</")));
  EXPECT_THAT(html, HasSubstr(std::string("<h1>") + kTame));
  EXPECT_THAT(html, HasSubstr(std::string("alt=\"") + kTame + "\""));
}

TEST(ReportHtml, SaysWhatIsUnknown) {
  ReportFacts facts;
  const std::string nothing = reportHtml(facts);
  EXPECT_THAT(nothing, HasSubstr("Scan report"));
  EXPECT_THAT(nothing, HasSubstr("it takes a whole turn"));
  EXPECT_THAT(nothing, HasSubstr("how good the calibration is, is unknown"));
  EXPECT_THAT(nothing, HasSubstr("the calibration does not say"));
  EXPECT_THAT(nothing, HasSubstr("<th>Surface</th><td>none"));
  facts.report.size_known = false;
  EXPECT_THAT(reportHtml(facts), HasSubstr("arbitrary units"));
}

TEST(ReportHtml, ListsWhatWasMeasured) {
  ReportFacts facts = sampleFacts();
  Measurement one;
  one.length_mm = 50.1;
  one.points_sigma_mm = 0.05;
  one.caliper_mm = 50.0;
  one.note = "rim";
  facts.measurements = {one};
  const std::string html = reportHtml(facts);
  EXPECT_THAT(html, HasSubstr("<td>rim</td><td>50.100 ± 0.050 mm</td><td>50 mm</td>"));
  EXPECT_THAT(html, HasSubstr("longer than the caliper"));
  EXPECT_THAT(reportHtml(sampleFacts()), Not(HasSubstr("Measured on the model")));
}

TEST(ReportHtml, TellsSeenFromGuessed) {
  ReportFacts facts = sampleFacts();
  facts.health.emplace();
  facts.health->area_mm2 = 1000.0;
  facts.health->unseen_area_mm2 = 125.0;
  const std::string html = reportHtml(facts);
  EXPECT_THAT(html, HasSubstr("87.5 %"));
  EXPECT_THAT(html, HasSubstr("12.5 %"));
}

TEST(SizeText, HoldsPointsAndScale) {
  EXPECT_EQ(sizeText({}), "unknown");
  EXPECT_EQ(sizeText(sampleFacts()), "40.00 × 40.00 × 60.00 mm, ± 0.024 mm from the points alone");
  // hypot(0.03 sqrt(2/3), 60 mm * 0.04 / 80)
  EXPECT_EQ(sizeText(calibratedFacts()), "40.00 × 40.00 × 60.00 mm, ± 0.039 mm");
}

TEST(HealthText, TellsClosedFromOpen) {
  MeshHealth health;
  health.closed = true;
  health.components = 1;
  health.triangles = 100;
  health.volume_mm3 = 92100.0;
  health.area_mm2 = 12300.0;
  health.genus = 1;
  EXPECT_EQ(healthText(health),
            "Closed, without holes, 92.1 cm³; 1 piece, 100 triangles, 123 cm². 1 tunnel leads "
            "through it.");
  health.closed = false;
  health.genus.reset();
  health.holes = 2;
  health.non_manifold_edges = 3;
  EXPECT_EQ(healthText(health),
            "Open, with 2 rims; 1 piece, 100 triangles, 123 cm². It touches itself at 3 places: "
            "mend that before printing.");
}

// RFC 4648, section 10.
TEST(Base64, IsThePublishedOne) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace gyre
