// Calibrates from published points and pictures, against the published results.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/corners/saddle_fit.h"
#include "core/calib/corners/x_corner_detector.h"
#include "core/calib/lens/calibrate_hand_held.h"
#include "core/calib/lens/calibrate_points.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"
#include "core/io/points_file.h"

namespace gyre {
namespace {

class PublishedCalibration : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("GYRE_TEST_DATA");
    if (root == nullptr) GTEST_SKIP() << "GYRE_TEST_DATA is not set";
    root_ = root;
  }

  std::filesystem::path root_;
};

constexpr double kElement_mm = 0.023;
const Eigen::Vector2d kFirstGuess_px(258.0, 204.0);

double meanMiss(const CalibrationReport& report) {
  double sum_px = 0.0;
  for (const CalibrationResidual& residual : report.residuals) {
    sum_px += residual.residual_px.norm();
  }
  return sum_px / static_cast<double>(report.residuals.size());
}

// Tsai's order of turns: about x, then y, then z.
Eigen::Matrix3d turned(double x_deg, double y_deg, double z_deg) {
  return (Eigen::AngleAxisd(radFromDeg(z_deg), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(radFromDeg(y_deg), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(radFromDeg(x_deg), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST_F(PublishedCalibration, ReachesTheReferenceOnItsOwnPoints) {
  const auto points = readPoints(root_ / "tsai_willson" / "ncc_cd.dat");
  ASSERT_TRUE(points) << points.error().sentence();
  PointsOptions options;
  options.principal_px = kFirstGuess_px;
  const auto found = calibratePoints(*points, options);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_LE(meanMiss(found->report), 0.0800);
  EXPECT_LE(found->report.rms_px, 0.0895);
  const CameraModel& camera = found->calibration.camera;
  EXPECT_NEAR(camera.fy * kElement_mm, 69.975, 0.25);
  EXPECT_NEAR(camera.fx / camera.fy, 1.0002, 0.0002);
  // Its kappa1 is per mm^2 on the sensor, where the points reach 0.06 focal lengths off the middle.
  EXPECT_NEAR(kappa1FromBrown(camera, 0.06) / std::pow(camera.fy * kElement_mm, 2.0), -6.067e-4,
              0.1e-4);
  const Rigid3& cam_from_table = *found->calibration.cam_from_table;
  EXPECT_NEAR(cam_from_table.translation.x(), -100.27, 0.5);
  EXPECT_NEAR(cam_from_table.translation.y(), -85.32, 0.5);
  EXPECT_NEAR(cam_from_table.translation.z(), 1999.8, 7.0);
  const Eigen::AngleAxisd miss(
      Eigen::Matrix3d(cam_from_table.rotation * turned(29.9937, 1.00195, 2.00537).transpose()));
  EXPECT_LT(miss.angle(), radFromDeg(0.02));
}

TEST_F(PublishedCalibration, BeginsAsWellWithoutAGuessOfTheCentre) {
  const auto points = readPoints(root_ / "tsai_willson" / "ncc_cd.dat");
  ASSERT_TRUE(points) << points.error().sentence();
  const auto found = calibratePoints(*points);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_LE(found->report.rms_px, 0.0895);
}

TEST_F(PublishedCalibration, RepeatsTheThreeParameterStep) {
  const auto points = readPoints(root_ / "tsai_willson" / "ncc_cd.dat");
  ASSERT_TRUE(points) << points.error().sentence();
  PointsOptions options;
  options.mode = PointsMode::kTsai;
  options.principal_px = kFirstGuess_px;
  const auto found = calibratePoints(*points, options);
  ASSERT_TRUE(found) << found.error().sentence();
  // The radial alignment has no unique least-squares form: its variants differ by 0.2 mm.
  EXPECT_NEAR(found->tsai.focal_px * kElement_mm, 68.17, 0.2);
  EXPECT_NEAR(meanMiss(found->report), 0.097, 0.002);
}

constexpr int kColumns = 11;
constexpr int kRows = 8;

Target chessboard() {
  Target target;
  target.faces.emplace_back();
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const int id = row * kColumns + column;
      target.corners.push_back({id, {30.0 * column, 30.0 * row, 0.0}});
      target.faces[0].push_back(id);
    }
  }
  return target;
}

// The corners of our detector in the order that OpenCV's finder gives them; empty when it finds no
// board.
TargetView chessboardView(const cv::Mat& grey, std::size_t& missing) {
  TargetView view;
  std::vector<cv::Point2f> order;
  if (!cv::findChessboardCorners(grey, {kColumns, kRows}, order)) return view;
  const std::vector<XCorner> corners = detectXCorners(grey);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Eigen::Vector2d guess(order[i].x, order[i].y);
    const auto near = std::find_if(corners.begin(), corners.end(), [&](const XCorner& corner) {
      return (corner.pixel - guess).norm() < 3.0;
    });
    if (near == corners.end()) {
      ++missing;
      continue;
    }
    view.sightings.push_back({static_cast<int>(i), near->pixel, near->sigma_px});
  }
  return view;
}

TEST_F(PublishedCalibration, CalibratesTheChessboardAsOpenCvDoes) {
  const auto pictures = listPictures(root_ / "chessboard");
  ASSERT_TRUE(pictures) << pictures.error().sentence();
  std::vector<TargetView> views;
  std::size_t missing = 0;
  Eigen::Vector2i size_px;
  for (const std::filesystem::path& picture : *pictures) {
    const auto frame = readPicture(picture);
    ASSERT_TRUE(frame) << frame.error().sentence();
    cv::Mat grey;
    cv::cvtColor(frame->image_bgr, grey, cv::COLOR_BGR2GRAY);
    size_px = {grey.cols, grey.rows};
    views.push_back(chessboardView(grey, missing));
    views.back().name = picture.filename().string();
  }
  const auto found = calibrateHandHeld(chessboard(), views, size_px);
  ASSERT_TRUE(found) << found.error().sentence();
  double squares = 0.0;
  for (const CalibrationResidual& residual : found->report.residuals) {
    squares += residual.residual_px.squaredNorm();
  }
  const double rms_of_all_px =
      std::sqrt(squares / static_cast<double>(found->report.residuals.size()));
  RecordProperty("rms_of_all_px", std::to_string(rms_of_all_px));
  RecordProperty("rms_px", std::to_string(found->report.rms_px));
  RecordProperty("fx", std::to_string(found->calibration.camera.fx));
  RecordProperty("fy", std::to_string(found->calibration.camera.fy));
  RecordProperty("cx", std::to_string(found->calibration.camera.cx));
  RecordProperty("cy", std::to_string(found->calibration.camera.cy));
  RecordProperty("sigma_f", std::to_string(found->report.focal_sigma_px));
  RecordProperty("views", std::to_string(found->report.views));
  RecordProperty("outliers", std::to_string(found->report.outliers));
  RecordProperty("missing", std::to_string(missing));
  // Not only of those that were used.
  EXPECT_LE(rms_of_all_px, 0.08);
  EXPECT_NEAR(found->calibration.camera.fx, 442.5, 0.5);
  EXPECT_NEAR(found->calibration.camera.fy, 442.5, 0.5);
  EXPECT_NEAR(found->calibration.camera.cx, 364.6, 1.0);
  EXPECT_NEAR(found->calibration.camera.cy, 248.6, 1.0);
  // The detector misses none but at the rim, and few corners are left out.
  EXPECT_LT(missing, 20U);
  EXPECT_LT(found->report.outliers, 45U);
}

}  // namespace
}  // namespace gyre
