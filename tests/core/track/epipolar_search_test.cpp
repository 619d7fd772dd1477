// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/epipolar_search.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

cv::Mat greyOf(const Frame& frame) {
  cv::Mat grey;
  cv::cvtColor(frame.image_bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

TEST(EpipolarSearch, FindsFeaturesAcrossAStepFarBeyondKlt) {
  const test::TurningCylinder world;
  const Calibration calibration = world.calibration();
  const SearchVolume volume = visibleVolume(calibration.camera, *calibration.cam_from_table);
  const EpipolarSearch search(calibration.camera, volume);
  const Rigid3 before = *calibration.cam_from_table;
  const Rigid3 after = camFromTable(before, radFromDeg(10));
  const cv::Mat before_grey = greyOf(world.render(0));
  const cv::Mat after_grey = greyOf(world.render(radFromDeg(10)));
  int found = 0;
  int tried = 0;
  for (double azimuth_deg = -40; azimuth_deg <= 30; azimuth_deg += 5) {
    for (double z = 8; z < 46; z += 6) {
      const double azimuth_rad = radFromDeg(azimuth_deg);
      const Eigen::Vector3d point(world.radius_mm * std::cos(azimuth_rad),
                                  world.radius_mm * std::sin(azimuth_rad), z);
      const Eigen::Vector2d from = *calibration.camera.project(before * point);
      const Eigen::Vector2d truth = *calibration.camera.project(after * point);
      ++tried;
      const auto match = search.find(before_grey, before, from, after_grey, after);
      if (match && (match->pixel - truth).norm() < 2.0) ++found;
    }
  }
  // The motion is up to 16 px; the patch is foreshortened by up to a fifth on the way.
  EXPECT_GT(found, tried * 8 / 10) << "of " << tried;
}

TEST(EpipolarSearch, HasNothingToSayOnPlainGroundOrOutsideTheVolume) {
  const test::TurningCylinder world;
  const Calibration calibration = world.calibration();
  const Rigid3 before = *calibration.cam_from_table;
  const Rigid3 after = camFromTable(before, radFromDeg(10));
  const cv::Mat grey = greyOf(world.render(0));
  const cv::Mat plain(grey.size(), CV_8U, cv::Scalar(100));
  const EpipolarSearch search(calibration.camera, {40.0, 0.0, 60.0});
  EXPECT_FALSE(search.find(plain, before, {200, 150}, plain, after));
  const EpipolarSearch thin(calibration.camera, {1.0, 0.0, 60.0});
  EXPECT_FALSE(thin.find(grey, before, {30, 150}, grey, after));
}

TEST(VisibleVolume, HoldsTheObjectAndEndsAtThePicture) {
  const test::TurningCylinder world;
  const Calibration calibration = world.calibration();
  const SearchVolume volume = visibleVolume(calibration.camera, *calibration.cam_from_table);
  EXPECT_GT(volume.radius_mm, world.radius_mm);
  EXPECT_GT(volume.z_max_mm, world.height_mm);
  // 400 px at 1100 px and 350 mm are 127 mm across.
  EXPECT_LT(volume.radius_mm, 90.0);
}

}  // namespace
}  // namespace gyre
