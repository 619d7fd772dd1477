// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/tsai.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.h"
#include "tests/support/known_views.h"

namespace gyre {
namespace {

const Eigen::Vector2d kMiddle_px(959.5, 539.5);

// Points as Tsai's own camera shows them.
std::vector<KnownPoint> tsaiPoints(const TsaiCamera& camera,
                                   const std::vector<Eigen::Vector3d>& places) {
  std::vector<KnownPoint> points;
  for (const Eigen::Vector3d& place : places)
    points.push_back({place, *projectTsai(camera, place)});
  return points;
}

TsaiCamera cubeCamera() {
  TsaiCamera camera;
  camera.focal_px = 1600.0;
  camera.aspect = 1.02;
  camera.principal_px = kMiddle_px;
  camera.kappa1 = 0.08;
  camera.cam_from_target = cubePose();
  return camera;
}

TEST(CalibrateTsai, IsExactOnExactPoints) {
  const TsaiCamera truth = cubeCamera();
  const auto found = calibrateTsai(tsaiPoints(truth, cubeCorners()), kMiddle_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->focal_px, truth.focal_px, 1e-5);
  EXPECT_NEAR(found->aspect, truth.aspect, 1e-9);
  EXPECT_NEAR(found->kappa1, truth.kappa1, 1e-7);
  EXPECT_LT(angleBetween(found->cam_from_target, truth.cam_from_target), 1e-8);
  EXPECT_LT((found->cam_from_target.translation - truth.cam_from_target.translation).norm(), 1e-5);
}

// Tsai's own form divides by ty.
TEST(CalibrateTsai, NeedsNoOffsetOfTheOrigin) {
  TsaiCamera truth = cubeCamera();
  truth.cam_from_target.translation.x() = 0.0;
  truth.cam_from_target.translation.y() = 0.0;
  const auto found = calibrateTsai(tsaiPoints(truth, cubeCorners()), kMiddle_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->focal_px, truth.focal_px, 1e-4);
}

TEST(CalibrateTsai, KeepsItsErrorUnderNoise) {
  const CameraModel camera = fullHdCamera(-0.08);
  double focal_error_px = 0.0;
  double centre_error_mm = 0.0;
  constexpr int kSeeds = 40;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto points =
        knownPoints(camera, cubePose(), cubeCorners(), 0.05, static_cast<std::uint64_t>(seed));
    const auto found = calibrateTsai(points, kMiddle_px);
    ASSERT_TRUE(found) << found.error().sentence();
    focal_error_px += std::abs(found->focal_px - camera.fy) / kSeeds;
    centre_error_mm +=
        (cameraCentre(found->cam_from_target) - cameraCentre(cubePose())).norm() / kSeeds;
  }
  RecordProperty("focal_error_px", std::to_string(focal_error_px));
  RecordProperty("centre_error_mm", std::to_string(centre_error_mm));
  // Known of the method on such a cube: 13 px and 3.1 mm.
  EXPECT_LT(focal_error_px, 13.0);
  EXPECT_LT(centre_error_mm, 3.1);
}

TEST(CalibrateTsai, SaysWhyItFails) {
  const TsaiCamera truth = cubeCamera();
  const auto cube = tsaiPoints(truth, cubeCorners());
  const auto whyNot = [](const std::vector<KnownPoint>& points) {
    const auto found = calibrateTsai(points, kMiddle_px);
    return found ? std::string("it did not fail") : found.error().sentence();
  };
  EXPECT_THAT(whyNot({}), testing::HasSubstr("Only 0 points"));
  EXPECT_THAT(whyNot({cube.begin(), cube.begin() + 6}), testing::HasSubstr("Only 6 points"));
  const auto flat = tsaiPoints(truth, gridCorners(5, 5, 10.0));
  EXPECT_THAT(whyNot(flat), testing::HasSubstr("in one plane"));
  EXPECT_THAT(whyNot(tsaiPoints(truth, gridCorners(9, 1, 10.0))), testing::HasSubstr("one line"));
  EXPECT_THAT(whyNot(std::vector<KnownPoint>(9, cube.front())), testing::HasSubstr("one line"));
  auto mirrored = cube;
  for (KnownPoint& point : mirrored) point.position_in_target.x() *= -1.0;
  EXPECT_THAT(whyNot(mirrored), testing::HasSubstr("mirrored"));
  mirrored = cube;
  for (KnownPoint& point : mirrored) point.pixel.x() = 1919.0 - point.pixel.x();
  EXPECT_THAT(whyNot(mirrored), testing::HasSubstr("mirrored"));
  auto damaged = cube;
  damaged[3].pixel.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(whyNot(damaged), testing::HasSubstr("not a number"));
  auto together = cube;
  for (KnownPoint& point : together) point.pixel = kMiddle_px;
  EXPECT_THAT(whyNot(together), testing::HasSubstr("do not determine"));
}

TEST(CalibrateTsaiCoplanar, IsExactOnAnyTiltedPlane) {
  TsaiCamera truth = cubeCamera();
  truth.aspect = 1.0;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1.0, 0.2, 1.2), Eigen::Vector3d(-0.9, 0.5, 1.0),
        Eigen::Vector3d(0.1, -1.3, 0.9)}) {
    truth.cam_from_target = lookAt({40.0, 30.0, 7.0}, direction, 400.0);
    auto places = gridCorners(8, 6, 12.0);
    for (Eigen::Vector3d& place : places) place.z() = 7.0 + 0.1 * place.x();
    const auto found = calibrateTsaiCoplanar(tsaiPoints(truth, places), kMiddle_px);
    ASSERT_TRUE(found) << found.error().sentence();
    EXPECT_NEAR(found->focal_px, truth.focal_px, 1e-3);
    EXPECT_LT(angleBetween(found->cam_from_target, truth.cam_from_target), 1e-6);
    EXPECT_LT((found->cam_from_target.translation - truth.cam_from_target.translation).norm(),
              1e-3);
  }
}

TEST(CalibrateTsaiCoplanar, SaysWhyItFails) {
  TsaiCamera truth = cubeCamera();
  EXPECT_FALSE(calibrateTsaiCoplanar(tsaiPoints(truth, cubeCorners()), kMiddle_px));
  EXPECT_FALSE(calibrateTsaiCoplanar(tsaiPoints(truth, gridCorners(2, 2, 9.0)), kMiddle_px));
  EXPECT_FALSE(calibrateTsaiCoplanar(tsaiPoints(truth, gridCorners(9, 1, 9.0)), kMiddle_px));
  truth.aspect = 1.0;
  truth.cam_from_target = lookAt({40.0, 30.0, 0.0}, {0.05, 0.0, 1.0}, 400.0);
  const auto square = calibrateTsaiCoplanar(tsaiPoints(truth, gridCorners(8, 6, 12.0)), kMiddle_px);
  ASSERT_FALSE(square);
  EXPECT_THAT(square.error().sentence(), testing::HasSubstr("Tilt it"));
}

TEST(TsaiModel, BecomesBrownsToAFewHundredthsOfAPixel) {
  TsaiCamera tsai = cubeCamera();
  // 35 degrees off the axis: beyond the corners of this camera's picture.
  constexpr double kRadius = 0.7;
  for (const double kappa1 : {-0.1, 0.0, 0.08, 0.2}) {
    tsai.kappa1 = kappa1;
    const CameraModel brown = brownFromTsai(tsai, kRadius);
    double worst_px = 0.0;
    for (double x = -0.5; x <= 0.5; x += 0.05) {
      const Eigen::Vector3d in_cam(x, 0.8 * x, 1.0);
      const Eigen::Vector3d in_target = tsai.cam_from_target.inverse() * in_cam;
      const Eigen::Vector2d miss =
          brown.pixelFromNormalized(in_cam.hnormalized()) - *projectTsai(tsai, in_target);
      worst_px = std::max(worst_px, miss.norm());
    }
    EXPECT_LT(worst_px, 0.05) << kappa1;
    EXPECT_NEAR(kappa1FromBrown(brown, kRadius), kappa1, 0.001 * std::abs(kappa1) + 1e-12);
  }
}

TEST(TsaiModel, HasTheKnownSeriesNearTheCentre) {
  TsaiCamera tsai = cubeCamera();
  const CameraModel brown = brownFromTsai(tsai, 0.0);
  EXPECT_DOUBLE_EQ(brown.k1, -0.08);
  EXPECT_DOUBLE_EQ(brown.k2, 3.0 * 0.08 * 0.08);
  EXPECT_DOUBLE_EQ(brown.k3, -12.0 * 0.08 * 0.08 * 0.08);
}

TEST(TsaiModel, ShowsNothingBehindTheCameraOrWhereTheLensFoldsBack) {
  TsaiCamera tsai;
  tsai.focal_px = 100.0;
  tsai.kappa1 = -0.5;
  EXPECT_TRUE(projectTsai(tsai, {0.1, 0.1, 1.0}));
  EXPECT_EQ(projectTsai(tsai, {0.0, 0.0, 1.0}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_FALSE(projectTsai(tsai, {0.1, 0.1, -1.0}));
  EXPECT_FALSE(projectTsai(tsai, {3.0, 0.1, 1.0}));
}

}  // namespace
}  // namespace gyre
