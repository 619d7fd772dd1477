// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/empty_table_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

cv::Mat grey(int level, int width_px = 32) {
  return cv::Mat(24, width_px, CV_8UC3, cv::Scalar::all(level));
}

int levelOf(const FramePtr& frame) { return frame->image_bgr.at<cv::Vec3b>(3, 4)[1]; }

TEST(EmptyTableFile, ComesBackWithItsAngle) {
  const TempDir dir;
  Frame frame;
  frame.image_bgr = grey(70);
  frame.table_angle_rad = radFromDeg(-28.65);
  ASSERT_TRUE(writeEmptyTable(dir.path(), frame));
  const auto read = readEmptyTable(dir.path());
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(levelOf(*read), 70);
  EXPECT_NEAR((*read)->table_angle_rad, frame.table_angle_rad, 1e-12);
  // A second one replaces it whole.
  frame.image_bgr = grey(90);
  frame.table_angle_rad = 1.5;
  ASSERT_TRUE(writeEmptyTable(dir.path(), frame));
  EXPECT_EQ(levelOf(*readEmptyTable(dir.path())), 90);
  EXPECT_NEAR((*readEmptyTable(dir.path()))->table_angle_rad, 1.5, 1e-12);
}

TEST(EmptyTableFile, IsAtAngleZeroWhereNobodySaid) {
  const TempDir dir;
  ASSERT_TRUE(writePicture(dir / "bare.png", grey(50)));
  EXPECT_EQ((*readEmptyTable(dir.path()))->table_angle_rad, 0.0);
  EXPECT_EQ((*readEmptyTable(dir / "bare.png"))->table_angle_rad, 0.0);
}

TEST(EmptyTableFile, IsTheMeanOfPicturesAtOneAngle) {
  const TempDir dir;
  ASSERT_TRUE(writePicture(dir / "1.png", grey(40)));
  ASSERT_TRUE(writePicture(dir / "2.png", grey(200)));
  ASSERT_TRUE(writePicture(dir / "3.png", grey(60)));
  EXPECT_EQ(levelOf(*readEmptyTable(dir.path())), 100);
  // A platter that turned between them would be smeared by the mean.
  putFile(dir / "angles.csv", "image,angle_deg\n1.png,20\n2.png,50\n3.png,20\n");
  const auto read = readEmptyTable(dir.path());
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(levelOf(*read), 50);
  EXPECT_NEAR((*read)->table_angle_rad, radFromDeg(20.0), 1e-12);
}

TEST(EmptyTableFile, RefusesWhatCannotBeMeant) {
  const TempDir dir;
  EXPECT_EQ(readEmptyTable(dir / "nowhere.png").error().code, Error::Code::kNotFound);
  EXPECT_EQ(readEmptyTable(dir.path()).error().code, Error::Code::kNotFound);
  ASSERT_TRUE(writePicture(dir / "1.png", grey(40)));
  ASSERT_TRUE(writePicture(dir / "2.png", grey(40, 48)));
  EXPECT_THAT(readEmptyTable(dir.path()).error().what, HasSubstr("differ in size"));
  putFile(dir / "angles.csv", "image,angle_deg\n1.png,20\n");
  EXPECT_THAT(readEmptyTable(dir.path()).error().what, HasSubstr("no angle for the picture"));
  putFile(dir / "angles.csv", "image,angle_deg\n1.png,20\n2.png,nan\n");
  EXPECT_THAT(readEmptyTable(dir.path()).error().what, HasSubstr("no usable angle"));
}

}  // namespace
}  // namespace gyre
