// The volume in which points are sought is that which the camera sees.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/search_volume.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gyre {
namespace {

CameraModel lens(double k1) {
  CameraModel camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = camera.fy = 2400.0;
  camera.cx = 639.5;
  camera.cy = 479.5;
  camera.k1 = k1;
  return camera;
}

// 360 mm from the table's middle, looking down 30 degrees.
Rigid3 camFromTable() {
  const double c = std::cos(0.5235987755982988);
  const double s = 0.5;
  Rigid3 cam_from_table;
  cam_from_table.rotation << 0, 1, 0, s, 0, -c, -c, 0, -s;
  cam_from_table.translation = {0, 0, 360};
  return cam_from_table;
}

TEST(SearchVolume, HoldsWhatTheCameraSees) {
  const SearchVolume volume = visibleVolume(lens(0.0), camFromTable());
  // Half the picture is 640 / 2400 of the distance wide: 96 mm at the axis.
  EXPECT_GT(volume.radius_mm, 96.0);
  EXPECT_LT(volume.radius_mm, 130.0);
  EXPECT_LT(volume.z_max_mm, 200.0);
}

TEST(SearchVolume, IsNotWidenedWhereDistortionFoldsBackIntoThePicture) {
  const SearchVolume plain = visibleVolume(lens(0.0), camFromTable());
  const SearchVolume barrel = visibleVolume(lens(-0.08), camFromTable());
  EXPECT_NEAR(barrel.radius_mm, plain.radius_mm, 5.0);
  EXPECT_NEAR(barrel.z_max_mm, plain.z_max_mm, 10.0);
}

}  // namespace
}  // namespace gyre
