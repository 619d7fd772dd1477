// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/v4l2_controls.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fake_v4l2.h"

namespace gyre {
namespace {

using test::FakeV4l2;
using testing::HasSubstr;

ControlState named(const std::vector<ControlState>& states, const std::string& name) {
  const auto found = std::find_if(states.begin(), states.end(),
                                  [&](const ControlState& state) { return state.name == name; });
  return found == states.end() ? ControlState{"missing", false, -1.0, ""} : *found;
}

TEST(LockV4l2Controls, EndsEveryAutomaticAndKeepsTheValuesThatItHadFound) {
  FakeV4l2 device = FakeV4l2::webcam();
  const auto locked = lockV4l2Controls(device);
  ASSERT_EQ(locked.size(), 6U);
  for (const ControlState& state : locked) {
    EXPECT_TRUE(state.locked) << state.name;
    EXPECT_EQ(state.remark, "") << state.name;
  }
  EXPECT_EQ(named(locked, "focus").value, 35.0);
  EXPECT_EQ(named(locked, "exposure").value, 250.0);
  EXPECT_EQ(named(locked, "gain").value, 64.0);
  EXPECT_EQ(named(locked, "white balance").value, 4100.0);
  EXPECT_EQ(device.controls[V4L2_CID_FOCUS_AUTO].value, 0);
  EXPECT_EQ(device.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(device.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].value, 0);
  EXPECT_EQ(device.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 0);
}

TEST(LockV4l2Controls, SetsTheMainsFrequencyOnlyWhenAsked) {
  FakeV4l2 device = FakeV4l2::webcam();
  EXPECT_EQ(named(lockV4l2Controls(device), "mains frequency").value, 60.0);
  EXPECT_EQ(named(lockV4l2Controls(device, {50}), "mains frequency").value, 50.0);
  EXPECT_EQ(device.controls[V4L2_CID_POWER_LINE_FREQUENCY].value,
            V4L2_CID_POWER_LINE_FREQUENCY_50HZ);
  device.controls[V4L2_CID_POWER_LINE_FREQUENCY] = {V4L2_CID_POWER_LINE_FREQUENCY_AUTO, 1, true};
  const ControlState mains = named(lockV4l2Controls(device, {50}), "mains frequency");
  EXPECT_FALSE(mains.locked);
  EXPECT_THAT(mains.remark, HasSubstr("--mains-hz"));
}

TEST(LockV4l2Controls, NamesWhatCannotBeLocked) {
  FakeV4l2 device = FakeV4l2::webcam();
  device.controls.erase(V4L2_CID_FOCUS_ABSOLUTE);           // fixed focus
  device.controls[V4L2_CID_EXPOSURE_AUTO].stubborn = true;  // says yes, stays automatic
  device.controls[V4L2_CID_AUTO_WHITE_BALANCE].read_only = true;
  device.controls[V4L2_CID_GAIN].wanders = true;
  const auto locked = lockV4l2Controls(device);
  EXPECT_FALSE(named(locked, "focus").locked);
  EXPECT_THAT(named(locked, "focus").remark, HasSubstr("does not offer"));
  for (const char* name : {"exposure", "white balance", "gain"}) {
    EXPECT_FALSE(named(locked, name).locked) << name;
    EXPECT_THAT(named(locked, name).remark, HasSubstr("keeps changing")) << name;
  }
}

TEST(LockV4l2Controls, DoesWithoutTheControlsThatACameraDoesNotHave) {
  FakeV4l2 device = FakeV4l2::webcam();
  device.controls.clear();
  const auto locked = lockV4l2Controls(device, {50});
  ASSERT_EQ(locked.size(), 4U);  // neither zoom nor mains frequency: nobody misses them
  for (const ControlState& state : locked) EXPECT_FALSE(state.locked) << state.name;
  device = FakeV4l2::webcam();
  device.controls.erase(V4L2_CID_FOCUS_AUTO);  // a focus that was never automatic
  device.controls[V4L2_CID_GAIN].flags = V4L2_CTRL_FLAG_DISABLED;
  EXPECT_TRUE(named(lockV4l2Controls(device), "focus").locked);
  EXPECT_FALSE(named(lockV4l2Controls(device), "gain").locked);
}

TEST(LockV4l2Controls, AsksAgainWhereABusyCameraAnswersWithAnError) {
  FakeV4l2 device = FakeV4l2::webcam();
  device.busy_answers = 2;
  for (const ControlState& state : lockV4l2Controls(device))
    EXPECT_TRUE(state.locked) << state.name;
}

TEST(LockV4l2Controls, SaysNothingIsLockedOfACameraThatIsGone) {
  FakeV4l2 device = FakeV4l2::webcam();
  device.gone = true;
  for (const ControlState& state : lockV4l2Controls(device)) EXPECT_FALSE(state.locked);
}

TEST(ReadV4l2Controls, ChangesNothingAndSeesWhatChanged) {
  FakeV4l2 device = FakeV4l2::webcam();
  EXPECT_FALSE(named(readV4l2Controls(device), "focus").locked);
  EXPECT_EQ(device.controls[V4L2_CID_FOCUS_AUTO].value, 1);
  lockV4l2Controls(device);
  device.controls[V4L2_CID_FOCUS_ABSOLUTE].value = 40;
  EXPECT_TRUE(named(readV4l2Controls(device), "focus").locked);
  EXPECT_EQ(named(readV4l2Controls(device), "focus").value, 40.0);
}

}  // namespace
}  // namespace gyre
