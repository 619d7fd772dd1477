// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/v4l2_modes.h"

#include <gtest/gtest.h>

#include "tests/support/fake_v4l2.h"

namespace gyre {
namespace {

using test::FakeV4l2;

TEST(ListModes, NamesEverySizeThatCanBeDecodedAtItsFastest) {
  FakeV4l2 device = FakeV4l2::webcam();
  const auto modes = listModes(device);
  ASSERT_EQ(modes.size(), 5U);  // all but H.264
  EXPECT_EQ(modes.front(), (VideoMode{640, 480, "YUYV", 30.0}));
  EXPECT_EQ(modes.back(), (VideoMode{1920, 1080, "MJPG", 30.0}));
  EXPECT_EQ(modes.back().text(), "1920x1080@MJPG");
}

TEST(ListModes, GivesTheEndsOfARangeOfSizes) {
  FakeV4l2 device;
  device.modes = {{V4L2_PIX_FMT_YUYV, 1600, 1200, {15}}};
  device.stepwise = true;
  const auto modes = listModes(device);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[0].text(), "1600x1200@YUYV");
  EXPECT_EQ(modes[1].text(), "160x120@YUYV");
  EXPECT_EQ(modes[0].frames_per_s, 15.0);
}

TEST(ListModes, IsEmptyForADeviceThatListsNoneOrIsGone) {
  FakeV4l2 device;
  EXPECT_TRUE(listModes(device).empty());
  device = FakeV4l2::webcam();
  device.gone = true;
  EXPECT_TRUE(listModes(device).empty());
  EXPECT_FALSE(currentMode(device));
}

TEST(BestMode, IsTheLargestThatIsFastEnough) {
  FakeV4l2 device = FakeV4l2::webcam();
  EXPECT_EQ(bestMode(listModes(device), 5.0)->text(), "1920x1080@MJPG");
  EXPECT_EQ(bestMode(listModes(device), 2.0)->text(), "2304x1536@YUYV");
  EXPECT_EQ(bestMode(listModes(device), 50.0)->text(), "1280x720@MJPG");
}

TEST(BestMode, IsTheFastestWhereNoneIsFastEnoughAndNoneWhereThereIsNone) {
  const VideoMode slow[] = {{640, 480, "YUYV", 1.0}, {320, 240, "YUYV", 3.0}};
  EXPECT_EQ(bestMode(slow, 5.0), slow[1]);
  EXPECT_FALSE(bestMode({}, 5.0));
}

TEST(BestMode, BelievesADriverThatTellsNoRates) {
  const VideoMode modes[] = {{640, 480, "YUYV", 30.0}, {1280, 960, "YUYV", 0.0}};
  EXPECT_EQ(bestMode(modes, 5.0), modes[1]);
}

TEST(CurrentMode, IsWhatTheDeviceReadsBack) {
  FakeV4l2 device = FakeV4l2::webcam();
  device.present = device.modes.back();
  EXPECT_EQ(currentMode(device), (VideoMode{1920, 1080, "MJPG", 30.0}));
  device.present.rates.clear();
  EXPECT_EQ(currentMode(device)->frames_per_s, 0.0);
}

TEST(ModesText, TellsTheLargestFirstAndNotAll) {
  FakeV4l2 device = FakeV4l2::webcam();
  EXPECT_EQ(modesText(listModes(device), 2), "2304x1536@YUYV@2, 1920x1080@YUYV@5");
  EXPECT_EQ(modesText({}, 2), "");
}

}  // namespace
}  // namespace gyre
