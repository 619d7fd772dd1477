// Reads the published pictures that GYRE_TEST_DATA holds, as `gyre reconstruct` will.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"

namespace gyre {
namespace {

class PublishedData : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Turntables, PublishedData,
                         testing::Values("middlebury_dino48", "oxford_dino"));

TEST_P(PublishedData, HasACalibrationAnglesAndPicturesThatFitTogether) {
  const char* root = std::getenv("GYRE_TEST_DATA");
  if (root == nullptr) GTEST_SKIP() << "GYRE_TEST_DATA is not set";
  const std::filesystem::path folder = std::filesystem::path(root) / GetParam();
  const auto calibration = readCalibration(folder / "calibration.json");
  ASSERT_TRUE(calibration) << calibration.error().sentence();
  const auto pictures = listPictures(folder / "images");
  ASSERT_TRUE(pictures) << pictures.error().sentence();
  const auto size = commonSize(*pictures);
  ASSERT_TRUE(size) << size.error().sentence();
  EXPECT_EQ(size->width_px, calibration->camera.width_px);
  EXPECT_EQ(size->height_px, calibration->camera.height_px);
  const auto angles = readAngles(folder / "angles.csv");
  ASSERT_TRUE(angles) << angles.error().sentence();
  const auto angles_rad = anglesOfPictures(*pictures, *angles);
  ASSERT_TRUE(angles_rad) << angles_rad.error().sentence();
  const auto frame = readPicture(pictures->back());
  ASSERT_TRUE(frame) << frame.error().sentence();
  EXPECT_EQ(frame->image_bgr.cols, size->width_px);
}

}  // namespace
}  // namespace gyre
