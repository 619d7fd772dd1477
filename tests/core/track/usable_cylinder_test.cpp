// The cylinder in which an object may stand stays in the picture, and could hardly be larger.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/usable_cylinder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace gyre {
namespace {

CameraModel lens() {
  CameraModel camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = camera.fy = 2400.0;
  camera.cx = 639.5;
  camera.cy = 479.5;
  return camera;
}

// At this distance from the table's middle, looking down so far.
Rigid3 camAt(double distance_mm, double down_deg, double aim_height_mm) {
  const double s = std::sin(radFromDeg(down_deg));
  const double c = std::cos(radFromDeg(down_deg));
  Rigid3 cam_from_table;
  cam_from_table.rotation << 0, 1, 0, s, 0, -c, -c, 0, -s;
  cam_from_table.translation = Eigen::Vector3d(0, 0, distance_mm) -
                               cam_from_table.rotation * Eigen::Vector3d(0, 0, aim_height_mm);
  return cam_from_table;
}

TEST(UsableCylinder, IsBoundedByThePicturesWidthSeenFromTheSide) {
  // A level look at half the height: the nearest point of a circle at radius r is r nearer.
  const double distance_mm = 360.0;
  const auto usable = usableCylinder(lens(), camAt(distance_mm, 0.0, 30.0));
  ASSERT_TRUE(usable.has_value());
  // The tangent from the camera to the circle meets the picture's edge, less a hundredth.
  const double tangent = (639.5 - 12.8) / 2400.0;
  const double largest_mm = distance_mm * tangent / std::sqrt(1.0 + tangent * tangent);
  EXPECT_LE(usable->radius_mm, largest_mm);
  EXPECT_GT(usable->radius_mm, 0.8 * largest_mm);
  EXPECT_GT(usable->height_mm, 50.0);
}

TEST(UsableCylinder, StaysInThePictureAndCouldNotBeMuchWider) {
  const Rigid3 pose = camAt(350.0, 30.0, 20.0);
  const auto usable = usableCylinder(lens(), pose);
  ASSERT_TRUE(usable.has_value());
  for (const double z : {0.0, 0.5 * usable->height_mm, usable->height_mm}) {
    EXPECT_TRUE(circleStaysInPicture(lens(), pose, usable->radius_mm, z)) << z;
  }
  const double wider_mm = 1.03 * usable->radius_mm;
  EXPECT_FALSE(circleStaysInPicture(lens(), pose, wider_mm, 0.0) &&
               circleStaysInPicture(lens(), pose, wider_mm, 1.03 * usable->height_mm));
}

TEST(UsableCylinder, GrowsWithTheDistance) {
  const auto near = usableCylinder(lens(), camAt(300.0, 30.0, 20.0));
  const auto far = usableCylinder(lens(), camAt(600.0, 30.0, 20.0));
  ASSERT_TRUE(near && far);
  EXPECT_GT(far->radius_mm, 1.5 * near->radius_mm);
}

TEST(UsableCylinder, IsDrawnInThePictureAndEndsBeforeItsEdge) {
  const Rigid3 pose = camAt(350.0, 30.0, 20.0);
  const auto usable = usableCylinder(lens(), pose);
  ASSERT_TRUE(usable.has_value());
  const auto lines = drawnInPicture(*usable, lens(), pose);
  EXPECT_GT(lines.size(), 100U);
  for (const PictureLine& line : lines) {
    EXPECT_TRUE(lens().contains(line.from) && lens().contains(line.to));
  }
  const PictureLine& axis = lines.back();
  EXPECT_NEAR((axis.from - *lens().project(pose * Eigen::Vector3d::Zero())).norm(), 0.0, 1e-9);
}

TEST(UsableCylinder, IsNoneWhereThePictureDoesNotShowTheAxisAtThePlatter) {
  EXPECT_FALSE(usableCylinder(lens(), camAt(350.0, 0.0, 200.0)).has_value());  // looks too high
  Rigid3 away = camAt(350.0, 30.0, 20.0);
  away.translation.z() = -350.0;  // the table is behind it
  EXPECT_FALSE(usableCylinder(lens(), away).has_value());
}

}  // namespace
}  // namespace gyre
