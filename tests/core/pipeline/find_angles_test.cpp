// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_angles.h"

#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/calibration_file.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

// Pictures of the cylinder in a folder, a step apart, before a wall that stands still.
PreparedPictures prepared(const std::filesystem::path& folder, int views, double step_deg) {
  const test::TurningCylinder world;
  std::filesystem::create_directories(folder / "pictures");
  for (int view = 0; view < views; ++view) {
    char name[16];
    std::snprintf(name, sizeof name, "v%02d.png", view);
    EXPECT_TRUE(writePicture(folder / "pictures" / name,
                             world.render(radFromDeg(step_deg * view)).image_bgr));
  }
  EXPECT_TRUE(writeCalibration(folder / "calibration.json", world.calibration()));
  PictureSet set;
  set.pictures = folder / "pictures";
  set.calibration = folder / "calibration.json";
  return preparePictures(set).value();
}

Result<TurnSteps> found(PreparedPictures& pictures) {
  return findAngles(pictures, matchPictures(pictures.views, {}).value());
}

TEST(FindAngles, OfATableThatTurnsCounterClockwise) {
  const TempDir dir;
  PreparedPictures pictures = prepared(dir.path(), 8, 6.0);
  const auto steps = found(pictures);
  ASSERT_TRUE(steps) << steps.error().sentence();
  EXPECT_NEAR(degFromRad(steps->common_rad), 6.0, 0.15);
  EXPECT_EQ(pictures.views.front().name, "v00.png");
  EXPECT_EQ(pictures.views.front().table_angle_rad, 0.0);
  EXPECT_NEAR(degFromRad(pictures.views.back().table_angle_rad), 42.0, 0.8);
}

TEST(FindAngles, OfATableThatTurnsClockwisePutsTheLastPictureFirst) {
  const TempDir dir;
  PreparedPictures pictures = prepared(dir.path(), 8, -6.0);
  const auto steps = found(pictures);
  ASSERT_TRUE(steps) << steps.error().sentence();
  EXPECT_NEAR(degFromRad(steps->common_rad), -6.0, 0.15);
  EXPECT_EQ(pictures.views.front().name, "v07.png");
  EXPECT_EQ(pictures.views.back().name, "v00.png");
  EXPECT_EQ(pictures.views.back().table_angle_rad, 0.0);
}

TEST(FindAngles, RefusesATableThatStandsStillAndChangesNothing) {
  const TempDir dir;
  PreparedPictures pictures = prepared(dir.path(), 5, 0.0);
  const auto steps = found(pictures);
  ASSERT_FALSE(steps);
  EXPECT_EQ(steps.error().code, Error::Code::kTooFew);
  EXPECT_EQ(pictures.views.front().name, "v00.png");
}

}  // namespace
}  // namespace gyre
