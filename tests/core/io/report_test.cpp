// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/units.h"
#include "core/io/json_text.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

PointCloud cloudWithSigmas(int count) {
  PointCloud cloud;
  for (int i = count; i > 0; --i) {
    Point point;
    point.covariance.diagonal() = Eigen::Vector3d(i * i, 0, 0);
    cloud.points.push_back(point);
  }
  return cloud;
}

Report sampleReport() {
  Report report;
  report.title = "Duck <yellow> & co";
  report.points = 5123;
  report.observations = 70000;
  report.rms_px = 0.31;
  report.median_px = 0.2;
  report.ray_distance_mm = 0.0625;
  report.seconds = {{"track", 12.5}, {"recover", 1.5}};
  report.sigma_mm = SigmaPercentiles{0.01, 0.02, 0.05};
  report.versions = {{"gyre", "0.1.0"}};
  report.options = {{"window", "21"}};
  report.drift.views = {{0, true, 0.02, 0.01, false}, {1, false}, {2, true, 1.5, 0.02, true}};
  report.drift.sentence = "It was bumped.";
  report.drift.platter = {{0, true, 0.125, 0.01, false}};
  report.turning = TurningReport{{{0, "view_0000.png", true, 0.0, 0.0, radFromDeg(0.25), false},
                                  {1, "view_0001.png", false, 0.5, 0.5, 0.0, false}},
                                 radFromDeg(0.5),
                                 radFromDeg(0.75),
                                 "It turned well."};
  report.inputs = {{"calibration", "rig.json"}};
  return report;
}

TEST(SigmaPercentiles, AreThoseOfThePoints) {
  const auto sigma = sigmaPercentiles(cloudWithSigmas(101));
  ASSERT_TRUE(sigma);
  EXPECT_DOUBLE_EQ(sigma->p05_mm, 6.0);
  EXPECT_DOUBLE_EQ(sigma->p50_mm, 51.0);
  EXPECT_DOUBLE_EQ(sigma->p95_mm, 96.0);
  EXPECT_DOUBLE_EQ(sigmaPercentiles(cloudWithSigmas(1))->p95_mm, 1.0);
  EXPECT_FALSE(sigmaPercentiles(PointCloud{}));
}

TEST(ReportJson, HoldsEveryPublishedKey) {
  const std::string json = reportJson(sampleReport());
  EXPECT_TRUE(checkJson(json, "f"));
  for (const char* key : {"\"points\": 5123",
                          "\"observations\": 70000",
                          "\"rms_px\": 0.31",
                          "\"median_px\": 0.2",
                          "\"calibration_error_mm\": 0.0625",
                          "\"closure_px\": null",
                          "\"closure_mm\": null",
                          "\"seconds\": {",
                          "\"track\": 12.5",
                          "\"sigma_mm\": {",
                          "\"p05\": 0.01",
                          "\"p50\": 0.02",
                          "\"p95\": 0.05",
                          "\"versions\": {",
                          "\"drift\": {",
                          "\"sentence\": \"It was bumped.\"",
                          "\"px\": 1.5",
                          "\"px\": null",
                          "\"platter\": [",
                          "\"px\": 0.125",
                          "\"turning\": {",
                          "\"rms_off_deg\": 0.5",
                          "\"worst_off_deg\": 0.75",
                          "\"sigma_deg\": 0.25",
                          "\"sigma_deg\": null",
                          "\"options\": {",
                          "\"inputs\": {",
                          "\"calibration\": \"rig.json\""}) {
    EXPECT_THAT(json, HasSubstr(key));
  }
}

TEST(ReportJson, IsJsonWhateverIsUnknown) {
  Report report;
  report.rms_px = std::numeric_limits<double>::quiet_NaN();
  report.closure_px = 0.4;
  report.title = "\xFF not UTF-8";
  const std::string json = reportJson(report);
  EXPECT_TRUE(checkJson(json, "f"));
  EXPECT_THAT(json, HasSubstr("\"rms_px\": null"));
  EXPECT_THAT(json, HasSubstr("\"closure_px\": 0.4"));
  EXPECT_THAT(json, HasSubstr("\"seconds\": {}"));
  EXPECT_THAT(json, HasSubstr("\"turning\": null"));
  EXPECT_THAT(json, HasSubstr("\"p50\": null"));
}

TEST(WriteReport, WritesOrSaysWhyNot) {
  const TempDir dir;
  ASSERT_TRUE(writeReport(dir.path(), sampleReport()));
  EXPECT_EQ(fileText(dir / "report.json"), reportJson(sampleReport()));
  EXPECT_EQ(writeReport(dir / "nowhere", sampleReport()).error().code, Error::Code::kNotFound);
}

}  // namespace
}  // namespace gyre
