// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/model_scale.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

// Points on a box, its foot at z.
std::vector<Eigen::Vector3d> box(const Eigen::Vector3d& size, double foot) {
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3d point(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                          random.uniform(-0.5, 0.5));
    point[i % 3] = point[i % 3] > 0.0 ? 0.5 : -0.5;
    points.push_back(point.cwiseProduct(size) + (foot + 0.5 * size.z()) * Eigen::Vector3d::UnitZ());
  }
  return points;
}

TEST(PlacementOf, ABoxGivesItsDiagonalAndItsFoot) {
  const auto placement = placementOf(box({3.0, 4.0, 12.0}, 7.0));
  EXPECT_NEAR(placement.length, 13.0, 0.25);  // stray points, the outermost corners, do not count
  EXPECT_NEAR(placement.lowest, 7.0, 0.02);
  EXPECT_FALSE(placement.platter_seen);
}

TEST(PlacementOf, AFewStrayPointsCountForNothing) {
  auto points = box({3.0, 4.0, 12.0}, 7.0);
  for (int i = 0; i < 10; ++i) points.push_back({100.0 * i, -50.0, -90.0});
  EXPECT_NEAR(placementOf(points).length, 13.0, 0.25);
  EXPECT_NEAR(placementOf(points).lowest, 7.0, 0.02);
}

TEST(PlacementOf, AThinWideLayerAtTheFootIsThePlatter) {
  auto points = box({3.0, 4.0, 12.0}, 7.0);
  Random random(2);
  for (int i = 0; i < 8000; ++i) {
    const double r = 9.0 * std::sqrt(random.uniform());
    const double turn = random.uniform(0.0, 6.28);
    points.push_back({r * std::cos(turn), r * std::sin(turn), 7.0 + 0.01 * random.gaussian()});
  }
  const auto placement = placementOf(points);
  EXPECT_TRUE(placement.platter_seen);
  EXPECT_NEAR(placement.lowest, 7.0, 0.02);
  EXPECT_NEAR(placement.length, 13.0, 0.4);  // the box without its lowest edge
}

TEST(PlacementOf, NoPointsGiveZeros) {
  EXPECT_EQ(placementOf({}).length, 0.0);
  EXPECT_EQ(placementOf({}).lowest, 0.0);
}

Calibration someCalibration() {
  Calibration calibration;
  calibration.camera = {640, 480, 900.0, 900.0, 0.0, 319.5, 239.5};
  Rigid3 pose;
  pose.rotation = (Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation = {0.2, -0.1, 9.0};
  calibration.cam_from_table = pose;
  return calibration;
}

TEST(ScaleCalibration, ShowsTheSamePictures) {
  const Calibration before = someCalibration();
  Calibration after = before;
  scaleCalibration(after, {2.0, -1.0, false}, 100.0);
  const std::vector<Eigen::Vector3d> points{{0.5, 0.2, -1.0}, {-0.3, 0.4, 0.8}};
  for (const Eigen::Vector3d& point : points) {
    // Fifty times as large; what was lowest is a little over the platter.
    const Eigen::Vector3d now =
        50.0 * (point + Eigen::Vector3d::UnitZ()) + Eigen::Vector3d(0, 0, 1.5);
    const auto then_px = before.camera.project(*before.cam_from_table * point);
    const auto now_px = after.camera.project(*after.cam_from_table * now);
    ASSERT_TRUE(then_px && now_px);
    EXPECT_LT((*then_px - *now_px).norm(), 1e-9);
  }
}

TEST(ScaleModel, GivesTheLengthAndScalesErrorBars) {
  Reconstruction model;
  for (const Eigen::Vector3d& position : box({3.0, 4.0, 12.0}, 0.0)) {
    Point point;
    point.position = position;
    point.covariance = 0.01 * Eigen::Matrix3d::Identity();
    model.cloud.points.push_back(point);
  }
  model.ray_distance_mm = 0.3;
  Calibration calibration = someCalibration();
  const double scale = scaleModel(model, calibration, 26.0);
  EXPECT_NEAR(scale, 2.0, 0.04);
  EXPECT_NEAR(model.cloud.points[0].covariance(1, 1), 0.01 * scale * scale, 1e-12);
  EXPECT_NEAR(model.ray_distance_mm, 0.3 * scale, 1e-12);
  EXPECT_NEAR(calibration.cam_from_table->translation.z(), 9.0 * scale, 1e-12);
}

TEST(ScaleModel, LeavesAModelWithoutPointsAlone) {
  Reconstruction model;
  Calibration calibration = someCalibration();
  EXPECT_EQ(scaleModel(model, calibration, 26.0), 1.0);
  EXPECT_EQ(calibration.cam_from_table->translation.z(), 9.0);
}

}  // namespace
}  // namespace gyre
