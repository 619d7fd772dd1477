// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/view_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(ViewSteps, EvenTurnsNeedNoWord) {
  EXPECT_THAT(viewStepsRemark(3200.0, 200), IsEmpty());
  EXPECT_THAT(viewStepsRemark(12288.0, 64), IsEmpty());
}

TEST(ViewSteps, UnevenTurnsAreToldWithTheEvenOnesNearby) {
  const std::string remark = viewStepsRemark(3200.0, 72);
  EXPECT_THAT(remark, HasSubstr("3200"));
  EXPECT_THAT(remark, HasSubstr("0.113\u00b0"));
  EXPECT_THAT(remark, HasSubstr("Even are 50, 64 or 80 views"));
  EXPECT_THAT(viewStepsRemark(12288.0, 36), HasSubstr("Even are 24, 32 or 48 views"));
}

TEST(ViewSteps, TurnThatIsNoWholeNumberOfStepsIsTold) {
  EXPECT_THAT(viewStepsRemark(3204.36, 72), HasSubstr("3204.36"));
}

TEST(ViewSteps, StepsWithoutDivisorsNearbyGetNoSuggestion) {
  EXPECT_THAT(viewStepsRemark(3203.0, 72), testing::Not(HasSubstr("Even are")));
}

}  // namespace
}  // namespace gyre
