// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/calibrate_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/known_views.h"

namespace gyre {
namespace {

std::vector<KnownPoint> cubeView(double noise_px = 0.05) {
  return knownPoints(fullHdCamera(-0.08), cubePose(), cubeCorners(), noise_px);
}

TEST(CalibratePoints, FindsCameraAndPlaceOfTheCube) {
  PointsOptions options;
  options.image_size_px = {1920, 1080};
  const auto found = calibratePoints(cubeView(), options);
  ASSERT_TRUE(found) << found.error().sentence();
  const CameraModel& camera = found->calibration.camera;
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_EQ(camera.height_px, 1080);
  EXPECT_LT(std::abs(camera.fy - 1600.0), 4.0 * found->report.focal_sigma_px);
  EXPECT_LT(std::abs(camera.cx - 959.5), 4.0 * found->report.principal_sigma_px);
  EXPECT_NEAR(camera.k1, -0.08, 4.0 * std::sqrt(found->covariance(kK1, kK1)));
  ASSERT_TRUE(found->calibration.cam_from_table);
  EXPECT_LT((cameraCentre(*found->calibration.cam_from_table) - cameraCentre(cubePose())).norm(),
            2.0);
  EXPECT_NEAR(found->report.rms_px, 0.05 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(found->report.sightings, 75U);
  EXPECT_EQ(found->report.residuals.size(), 75U);
  EXPECT_EQ(found->report.views, 1U);
}

TEST(CalibratePoints, WorksWithoutTheSizeOfTheImage) {
  const auto points = cubeView();
  const auto found = calibratePoints(points);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->calibration.camera.fy, 1600.0, 4.0 * found->report.focal_sigma_px);
  // Equal margins left and right.
  double least = 1e9;
  double most = 0.0;
  for (const KnownPoint& point : points) {
    least = std::min(least, point.pixel.x());
    most = std::max(most, point.pixel.x());
  }
  EXPECT_NEAR(found->calibration.camera.width_px - 1 - most, least, 1.0);
}

TEST(CalibratePoints, FreesTheSkewInThePapersMode) {
  CameraModel skewed = fullHdCamera(-0.08);
  skewed.skew = 5.0;
  const auto points = knownPoints(skewed, cubePose(), cubeCorners(), 0.0);
  PointsOptions options;
  options.image_size_px = {1920, 1080};
  options.mode = PointsMode::kPaper;
  const auto paper = calibratePoints(points, options);
  ASSERT_TRUE(paper) << paper.error().sentence();
  EXPECT_NEAR(paper->calibration.camera.skew, 5.0, 1e-4);
  EXPECT_LT(paper->report.rms_px, 1e-5);
  options.mode = PointsMode::kFull;
  EXPECT_GT(calibratePoints(points, options)->report.rms_px, 0.1);
}

TEST(CalibratePoints, KeepsThePrincipalPointInTsaisMode) {
  PointsOptions options;
  options.image_size_px = {1920, 1080};
  options.principal_px = {950.0, 545.0};
  options.mode = PointsMode::kTsai;
  const auto found = calibratePoints(cubeView(), options);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_DOUBLE_EQ(found->calibration.camera.cx, 950.0);
  EXPECT_DOUBLE_EQ(found->report.focal_sigma_px, 0.0);
  EXPECT_DOUBLE_EQ(found->tsai.focal_px, found->calibration.camera.fy);
  // A tilted plane suffices here, and only here.
  const Rigid3 tilted = lookAt({40.0, 30.0, 0.0}, {1.0, 0.2, 1.2}, 400.0);
  const auto flat = knownPoints(fullHdCamera(), tilted, gridCorners(8, 6, 12.0), 0.0);
  options.principal_px.reset();
  ASSERT_TRUE(calibratePoints(flat, options));
  EXPECT_NEAR(calibratePoints(flat, options)->calibration.camera.fy, 1600.0, 1e-3);
  options.mode = PointsMode::kFull;
  EXPECT_THAT(calibratePoints(flat, options).error().sentence(), testing::HasSubstr("one plane"));
}

TEST(CalibratePoints, SaysWhyItFails) {
  EXPECT_THAT(calibratePoints({}).error().sentence(), testing::HasSubstr("No points"));
  const auto points = cubeView();
  EXPECT_FALSE(calibratePoints(std::span(points).first(6)));
  PointsOptions options;
  options.image_size_px = {640, 480};
  EXPECT_THAT(calibratePoints(points, options).error().sentence(), testing::HasSubstr("outside"));
  auto damaged = points;
  damaged[0].pixel.x() = std::nan("");
  EXPECT_FALSE(calibratePoints(damaged));
  options.image_size_px = {1920, 1080};
  EXPECT_FALSE(calibratePoints(damaged, options));
}

}  // namespace
}  // namespace gyre
