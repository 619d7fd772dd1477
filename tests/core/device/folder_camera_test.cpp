// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/folder_camera.h"

#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

Result<cv::Mat> read(const std::filesystem::path& path) {
  if (path.stem() == "torn") return Error{Error::Code::kIo, "The picture is cut off.", ""};
  return cv::Mat(3, 4, CV_8UC3);
}

TEST(FolderCamera, GivesThePicturesInOrderAndThenSaysThatThereAreNoMore) {
  FolderCamera camera({"a/1.png", "a/2.png"}, read);
  EXPECT_EQ(camera.grabAfter(steadySeconds(), {}).value()->name, "1.png");
  EXPECT_EQ(camera.grabAfter(steadySeconds(), {}).value()->name, "2.png");
  EXPECT_EQ(camera.info().width_px, 4);
  const auto nothing = camera.grabAfter(steadySeconds(), {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Error::Code::kNotFound);
  EXPECT_NE(nothing.error().what.find("All 2 pictures"), std::string::npos);
}

TEST(FolderCamera, ShowsOneViewTwiceToWhoLooksTwice) {
  FolderCamera camera({"1.png", "2.png"}, read);
  const FramePtr first = camera.grabAfter(steadySeconds(), {}).value();
  EXPECT_EQ(camera.grabAfter(first->time_s, {}).value(), first);
  EXPECT_EQ(camera.grabAfter(steadySeconds(), {}).value()->name, "2.png");
}

TEST(FolderCamera, GoesOnWhereItIsTold) {
  FolderCamera camera({"1.png", "2.png", "3.png"}, read);
  camera.goTo(2);
  EXPECT_EQ(camera.grabAfter(0, {}).value()->name, "3.png");
}

TEST(FolderCamera, HandsOnWhyAPictureCannotBeRead) {
  FolderCamera camera({"torn.png"}, read);
  EXPECT_EQ(camera.grabAfter(0, {}).error().what, "The picture is cut off.");
}

}  // namespace
}  // namespace gyre
