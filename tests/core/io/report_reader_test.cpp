// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/calibration_record_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

Report sampleReport() {
  Report report;
  report.title = "Duck \"<yellow>\"";
  report.inventory_number = "A 7";
  report.rights = "CC0";
  report.date = "2026-01-02T03:04:05Z";
  report.size_known = false;
  report.points = 5123;
  report.observations = 70000;
  report.rms_px = 1.0 / 3.0;
  report.median_px = 0.2;
  report.ray_distance_mm = 0.0625;
  report.closure_px = 0.4;
  report.sigma_mm = SigmaPercentiles{0.01, 0.02, 0.05};
  report.drift.sentence = "Nothing moved.";
  report.drift.views = {{0, true, 0.02, 0.01, false}};
  report.turning.emplace();
  report.turning->sentence = "It turned well.";
  report.seconds = {{"track", 12.5}};
  report.versions = {{"Gyre", "0.1.0"}};
  report.options = {{"window", "21"}};
  report.inputs = {{"calibration", "rig.json"}};
  return report;
}

TEST(ReadReport, GivesBackWhatPeopleAreTold) {
  const Report told = sampleReport();
  const auto read = parseReport(reportJson(told), "f");
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(read->title, told.title);
  EXPECT_EQ(read->inventory_number, told.inventory_number);
  EXPECT_EQ(read->rights, told.rights);
  EXPECT_EQ(read->date, told.date);
  EXPECT_FALSE(read->size_known);
  EXPECT_EQ(read->points, told.points);
  EXPECT_EQ(read->observations, told.observations);
  EXPECT_EQ(read->rms_px, told.rms_px);
  EXPECT_EQ(read->median_px, told.median_px);
  EXPECT_EQ(read->ray_distance_mm, told.ray_distance_mm);
  EXPECT_EQ(read->closure_px, told.closure_px);
  EXPECT_FALSE(read->closure_mm);
  ASSERT_TRUE(read->sigma_mm);
  EXPECT_EQ(read->sigma_mm->p95_mm, 0.05);
  EXPECT_EQ(read->drift.sentence, told.drift.sentence);
  ASSERT_TRUE(read->turning);
  EXPECT_EQ(read->turning->sentence, told.turning->sentence);
  EXPECT_EQ(read->seconds, told.seconds);
  EXPECT_EQ(read->versions, told.versions);
  EXPECT_EQ(read->options, told.options);
  EXPECT_EQ(read->inputs, told.inputs);
}

TEST(ReadReport, TakesWhatIsMissingOrOddAsUnknown) {
  const auto read = parseReport(
      R"({"points": -5, "sigma_mm": 7, "seconds": [], "versions": {"a": 1}, "closure_px": "x",
          "size_known": null, "turning": null})",
      "f");
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(read->points, 0U);
  EXPECT_FALSE(read->sigma_mm);
  EXPECT_FALSE(read->closure_px);
  EXPECT_FALSE(read->turning);
  EXPECT_TRUE(read->versions.empty());
  EXPECT_TRUE(read->size_known);
}

TEST(ReadReport, RefusesWhatIsNone) {
  EXPECT_THAT(parseReport("[1]", "f").error().what, HasSubstr("no report"));
  EXPECT_THAT(parseReport("{\"points\":", "f").error().what, HasSubstr("line"));
}

TEST(ScaleOfResult, ComesFromTheCalibrationUnlessNothingToldTheScale) {
  const TempDir dir;
  EXPECT_EQ(scaleOfResult(dir.path()).trust, SizeTrust::kUnknown);
  CalibrationRecord record;
  CameraModel& camera = record.calibration.camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx = camera.fy = 1000.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  record.calibration.cam_from_table = Rigid3{};
  record.report.emplace();
  record.report->object_size_mm = 80.0;
  record.report->overall_size_mm = 0.04;
  record.report->size_verified = true;
  ASSERT_TRUE(writeCalibrationRecord(dir / "calibration.json", record));
  EXPECT_EQ(scaleOfResult(dir.path()).trust, SizeTrust::kVerified);
  EXPECT_DOUBLE_EQ(*scaleOfResult(dir.path()).sigma_share, 5e-4);
  ASSERT_TRUE(writeReport(dir.path(), sampleReport()));
  EXPECT_EQ(scaleOfResult(dir.path()).trust, SizeTrust::kArbitrary);
}

}  // namespace
}  // namespace gyre
