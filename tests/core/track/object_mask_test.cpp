// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/geometry/ray.h"
#include "core/track/empty_table_mask.h"
#include "core/track/mask_cleaning.h"
#include "core/track/moving_mask.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

// The cylinder turns in itself, so its true mask is the same at every angle.
cv::Mat trueMask(const test::TurningCylinder& world) {
  const Calibration calibration = world.calibration();
  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  cv::Mat mask = cv::Mat::zeros(calibration.camera.height_px, calibration.camera.width_px, CV_8U);
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      const Ray ray{base_from_cam.translation,
                    base_from_cam.rotation * calibration.camera.rayInCam({column, row})};
      if (crossCylinder(ray, world.radius_mm, 0.0, world.height_mm)) {
        mask.at<std::uint8_t>(row, column) = 255;
      }
    }
  }
  return mask;
}

double overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

TEST(EmptyTableMask, FindsTheObjectBeforeAWallAndOnATurningPlatter) {
  const test::TurningCylinder world;
  const auto empty = std::make_shared<const Frame>(world.renderEmpty());
  const EmptyTableMask mask(world.calibration(), empty);
  for (const double angle_deg : {0.0, 37.0, 200.0}) {
    EXPECT_GT(overlap(mask.maskOf(world.render(radFromDeg(angle_deg))), trueMask(world)), 0.9)
        << angle_deg;
  }
}

TEST(EmptyTableMask, TakesAnEmptyTableAtAnotherAngle) {
  const test::TurningCylinder world;
  const auto empty = std::make_shared<const Frame>(world.renderEmpty(radFromDeg(90)));
  const EmptyTableMask mask(world.calibration(), empty);
  EXPECT_GT(overlap(mask.maskOf(world.render(radFromDeg(130))), trueMask(world)), 0.9);
}

TEST(EmptyTableMask, SeesNothingOnTheBareTable) {
  const test::TurningCylinder world;
  const auto empty = std::make_shared<const Frame>(world.renderEmpty());
  const EmptyTableMask mask(world.calibration(), empty);
  const cv::Mat found = mask.maskOf(world.renderEmpty(radFromDeg(25)));
  EXPECT_LT(cv::countNonZero(found), found.rows * found.cols / 100);
}

TEST(EmptyTableMask, TellsAnObjectWhoseColourTheBackgroundHasOnlyByParts) {
  const test::TurningCylinder world;
  Frame empty = world.renderEmpty();
  // Before stripes of two colours stands a plain object: each of its channels lies between those of
  // the stripes, but no pixel of the stripes is like it.
  for (int row = 0; row < empty.image_bgr.rows; ++row) {
    for (int column = 0; column < empty.image_bgr.cols; ++column) {
      const bool even = column / 2 % 2 == 0;
      empty.image_bgr.at<cv::Vec3b>(row, column) =
          even ? cv::Vec3b(220, 40, 60) : cv::Vec3b(40, 220, 160);
    }
  }
  const EmptyTableMask mask(world.calibration(), std::make_shared<const Frame>(empty));
  Frame frame = empty;
  frame.image_bgr = empty.image_bgr.clone();
  const cv::Rect object(150, 100, 90, 80);
  frame.image_bgr(object).setTo(cv::Scalar(130, 130, 110));
  cv::Mat truth = cv::Mat::zeros(frame.image_bgr.size(), CV_8U);
  truth(object).setTo(255);
  EXPECT_GT(overlap(mask.maskOf(frame), truth), 0.85);
}

TEST(MovingMask, FindsTheObjectOnceTheTableHasTurned) {
  const test::TurningCylinder world;
  MovingMask moving;
  cv::Mat mask;
  for (int view = 0; view < 12; ++view) mask = moving.addFrame(world.render(radFromDeg(30 * view)));
  // The platter turns too and is found with the object; the wall must not be.
  cv::Mat inside = trueMask(world) & mask;
  EXPECT_GT(cv::countNonZero(inside), 0.9 * cv::countNonZero(trueMask(world)));
  EXPECT_EQ(cv::countNonZero(mask.rowRange(0, 20)), 0);
}

TEST(MovingMask, SaysEverythingWhileItKnowsNothing) {
  const test::TurningCylinder world;
  MovingMask moving;
  const cv::Mat mask = moving.addFrame(world.render(0));
  EXPECT_EQ(cv::countNonZero(mask), mask.rows * mask.cols);
}

TEST(CleanMask, FillsHolesDropsSpecksAndKeepsGapsToTheBorder) {
  cv::Mat changed = cv::Mat::zeros(240, 320, CV_8U);
  changed(cv::Rect(100, 60, 120, 120)).setTo(255);
  changed(cv::Rect(150, 110, 8, 8)).setTo(0);  // a hole by chance
  changed(cv::Rect(10, 10, 3, 3)).setTo(255);  // a speck
  const cv::Mat mask = cleanMask(changed, 0.02);
  EXPECT_EQ(mask.at<std::uint8_t>(114, 154), 255);
  EXPECT_EQ(mask.at<std::uint8_t>(11, 11), 0);
  EXPECT_EQ(mask.at<std::uint8_t>(5, 300), 0);
}

TEST(CleanMask, KeepsAHandlesGap) {
  cv::Mat changed = cv::Mat::zeros(240, 320, CV_8U);
  changed(cv::Rect(100, 60, 120, 120)).setTo(255);
  changed(cv::Rect(130, 90, 50, 50)).setTo(0);
  EXPECT_EQ(cleanMask(changed, 0.02).at<std::uint8_t>(115, 155), 0);
}

TEST(CleanMask, TakesAnEmptyPicture) {
  EXPECT_EQ(cv::countNonZero(cleanMask(cv::Mat::zeros(240, 320, CV_8U), 0.02)), 0);
}

}  // namespace
}  // namespace gyre
