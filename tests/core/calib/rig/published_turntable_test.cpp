// A real stepper turntable with four loose markers: axis and angles by vision.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/aruco.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/calib/rig/rig_bundle.h"

namespace gyre {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

const std::vector<int> kIds = {5, 18, 27, 42};

// Four markers of 30 mm; where they lie is not known and does not matter.
Target looseMarkers() {
  Target target;
  target.name = "four markers";
  target.dictionary = "DICT_4X4_50";
  for (const int id : kIds) {
    target.markers.push_back({id, {{{-15, 15, 0}, {15, 15, 0}, {15, -15, 0}, {-15, -15, 0}}}});
  }
  return target;
}

CameraModel publishedCamera() {
  CameraModel camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx = 620.2678375549896;
  camera.fy = 618.61305587237;
  camera.cx = 322.94579652113293;
  camera.cy = 239.42135627438046;
  camera.k1 = 0.11369913583372294;
  camera.k2 = -0.193716412669678;
  camera.p1 = -0.0011143493279290875;
  camera.p2 = -0.0021599136353324592;
  camera.k3 = -0.03519351082447173;
  return camera;
}

TargetView viewOf(const std::filesystem::path& file) {
  TargetView view;
  view.name = file.filename().string();
  const cv::Mat picture = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  // Seen aslant, the cells of the code are 8 px high: a wider window would look into them.
  parameters->cornerRefinementWinSize = 3;
  cv::aruco::detectMarkers(picture, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50),
                           corners, ids, parameters);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto found = std::find(kIds.begin(), kIds.end(), ids[i]);
    if (found == kIds.end()) continue;
    const auto marker = static_cast<int>(found - kIds.begin());
    for (int corner = 0; corner < 4; ++corner) {
      const cv::Point2f& p = corners[i][static_cast<std::size_t>(corner)];
      view.sightings.push_back({4 * marker + corner, {p.x, p.y}, 0.3});
    }
  }
  return view;
}

std::vector<TargetView> publishedViews(const std::filesystem::path& folder) {
  std::vector<TargetView> views;
  std::vector<std::pair<int, std::filesystem::path>> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const std::size_t digits = stem.find_first_of("0123456789");
    if (digits == std::string::npos) continue;
    files.emplace_back(std::stoi(stem.substr(digits)), entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& [number, file] : files) views.push_back(viewOf(file));
  return views;
}

TEST(PublishedTurntable, GivesAxisAnglesRestartAndRipple) {
  const char* data = std::getenv("GYRE_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "GYRE_TEST_DATA names no folder of published pictures.";
  const auto folder = std::filesystem::path(data) / "uib_turntable" / "table";
  const std::vector<TargetView> views = publishedViews(folder);
  ASSERT_EQ(views.size(), 160U);

  RigBundleOptions options;
  options.image_width_px = 640;
  options.image_height_px = 480;
  options.fixed_camera = publishedCamera();
  options.shape = TargetShape::kLooseMarkers;
  const auto found = calibrateRig(views, looseMarkers(), options, Task{});
  ASSERT_TRUE(found) << found.error().sentence();
  const CalibrationReport& report = found->report;
  EXPECT_LE(report.median_px, 0.26);
  EXPECT_EQ(report.angles_rad.size(), 160U);
  EXPECT_EQ(report.direction, 1);
  // The first step is short; the capture was stopped and started again at pictures 44 to 46.
  EXPECT_THAT(report.remarks, Contains(HasSubstr("step_num_table1.jpg and step_num_table3.jpg")));
  EXPECT_THAT(report.remarks,
              Contains(AllOf(HasSubstr("step_num_table43.jpg and step_num_table47.jpg"),
                             HasSubstr("instead of 2.24 deg"))));
  // Eight of the table's steps of 1.125 deg: four of the pictures, which are every second one.
  EXPECT_THAT(report.remarks, Contains(AllOf(HasSubstr("ripples"), HasSubstr("(4.0 pictures)"))));
  RecordProperty("median_px", std::to_string(report.median_px));
  RecordProperty("rms_px", std::to_string(report.rms_px));
}

}  // namespace
}  // namespace gyre
