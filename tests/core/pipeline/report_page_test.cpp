// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/report_page.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/io/angles_file.h"
#include "core/io/measurements_file.h"
#include "core/io/picture_file.h"
#include "core/io/ply.h"
#include "tests/support/surfaces.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> captionsOf(const ReportFacts& facts) {
  std::vector<std::string> captions;
  for (const InlinePicture& each : facts.pictures) captions.push_back(each.caption);
  return captions;
}

class ReportPage : public testing::Test {
 protected:
  ReportPage() {
    Report report;
    report.title = "Ball";
    report.points = 3;
    report.inputs["pictures"] = (dir_ / "photos").string();
    EXPECT_TRUE(writeReport(dir_.path(), report));
  }
  ReportFacts facts() const {
    const auto read = reportFactsOf(dir_.path());
    EXPECT_TRUE(read) << read.error().sentence();
    return *read;
  }
  TempDir dir_;
};

TEST_F(ReportPage, IsMadeOfWhatIsThere) {
  EXPECT_TRUE(facts().pictures.empty());
  EXPECT_FALSE(facts().health);

  ASSERT_TRUE(writePly(dir_ / "points.ply", test::sphereCloud(500, 10.0)));
  EXPECT_THAT(captionsOf(facts()),
              ElementsAre("From the front", "From the right", "From behind", "From the left"));
  EXPECT_NEAR(facts().bounds.diagonal(), 20.0 * std::sqrt(3.0), 0.2);
  EXPECT_FALSE(facts().health);

  ASSERT_TRUE(writePly(dir_ / "mesh.ply", test::sphereMesh(10.0)));
  std::filesystem::create_directory(dir_ / "photos");
  ASSERT_TRUE(writePicture(dir_ / "photos" / "b.png", cv::Mat(30, 40, CV_8UC3, cv::Scalar(9))));
  ASSERT_TRUE(writeAngleList(dir_ / "angles_solved.csv", {{"b.png", 0.0}, {"a.png", 0.1}}));
  EXPECT_THAT(captionsOf(facts()), ElementsAre("Picture b.png", "From the front", "From the right",
                                               "From behind", "From the left"));
  EXPECT_TRUE(facts().health);
  EXPECT_TRUE(facts().doubts.empty());
}

TEST_F(ReportPage, TellsOfNewMeasurementsAndNewNames) {
  ASSERT_TRUE(writeReportPage(dir_.path()));
  EXPECT_THAT(fileText(dir_ / "report.html"), HasSubstr("<h1>Ball"));
  Measurement one;
  one.length_mm = 12.5;
  one.note = "rim to foot";
  ASSERT_TRUE(addMeasurement(dir_.path(), one));
  putFile(dir_ / "a.gyre",
          R"({"format":"gyre-scan","version":1,"title":"Bowl 7","views":2,"start_angle_rad":0})");
  ASSERT_TRUE(writeReportPage(dir_.path()));
  EXPECT_THAT(fileText(dir_ / "report.html"), HasSubstr("<h1>Bowl 7"));
  EXPECT_THAT(fileText(dir_ / "report.html"), HasSubstr("rim to foot"));
}

TEST_F(ReportPage, SaysWhatCannotBeRead) {
  for (const char* name : {"calibration.json", "measurements.json", "mesh.ply"}) {
    putFile(dir_ / name, "broken");
  }
  EXPECT_EQ(facts().doubts.size(), 3U);
  ASSERT_TRUE(writeReportPage(dir_.path()));
  EXPECT_THAT(fileText(dir_ / "report.html"), HasSubstr("measurements.json"));
}

TEST(WriteReportPage, NeedsAReport) {
  const TempDir dir;
  EXPECT_EQ(writeReportPage(dir.path()).error().code, Error::Code::kNotFound);
}

}  // namespace
}  // namespace gyre
