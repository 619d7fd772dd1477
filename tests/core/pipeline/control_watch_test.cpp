// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/control_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<ControlState> locked() {
  return {{"focus", true, 35.0, ""}, {"gain", true, 64.0, ""}, {"exposure", false, 250.0, "auto"}};
}

TEST(ControlWatch, SaysNothingWhileNothingChanges) {
  ControlWatch watch(locked());
  EXPECT_THAT(watch.look(locked(), 3), IsEmpty());
  EXPECT_THAT(watch.look({}, 4), IsEmpty()) << "a camera that tells nothing";
}

TEST(ControlWatch, TellsEachChangeOnceWithItsView) {
  ControlWatch watch(locked());
  auto now = locked();
  now[0].value = 40.0;
  EXPECT_THAT(watch.look(now, 11),
              ElementsAre("The camera's focus changed from 35 to 40 at view 12."));
  EXPECT_THAT(watch.look(now, 12), IsEmpty());
  now[1].locked = false;
  EXPECT_THAT(watch.look(now, 13), ElementsAre("The camera's gain is automatic again at view 14."));
  now[0].value = 35.0;
  EXPECT_THAT(watch.look(now, 14),
              ElementsAre("The camera's focus changed from 40 to 35 at view 15."));
}

TEST(ControlWatch, LeavesAloneWhatWasNeverLocked) {
  ControlWatch watch(locked());
  auto now = locked();
  now[2].value = 500.0;
  EXPECT_THAT(watch.look(now, 0), IsEmpty());
}

TEST(ControlWatch, ComparesWordsWhereTheCameraDoesNotCount) {
  ControlWatch watch({{"white balance", true, 0.0, "", "Daylight"}});
  EXPECT_THAT(watch.look({{"white balance", true, 0.0, "", "Cloudy"}}, 0),
              ElementsAre("The camera's white balance changed from Daylight to Cloudy at view 1."));
}

TEST(SameLens, RefusesAnotherFocusAndPassesOverTheRest) {
  EXPECT_TRUE(sameLens(locked(), locked()));
  EXPECT_TRUE(sameLens(locked(), {}));
  EXPECT_TRUE(sameLens({}, locked()));
  auto now = locked();
  now[1].value = 1.0;
  EXPECT_TRUE(sameLens(locked(), now)) << "gain is no lens";
  now[0].value = 36.0;
  const auto same = sameLens(locked(), now);
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().code, Error::Code::kRejected);
  EXPECT_THAT(same.error().what, testing::HasSubstr("focus is 36; it was 35"));
}

}  // namespace
}  // namespace gyre
