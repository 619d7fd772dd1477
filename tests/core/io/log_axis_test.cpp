// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/log_axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

auto near(double value) { return DoubleNear(value, 1e-9 * value); }

TEST(LogAxis, PutsEqualRatiosAtEqualDistances) {
  const LogAxis axis(1.0, 100.0, 20.0, 220.0);
  EXPECT_NEAR(axis.placeOf(1.0), 20.0, 1e-9);
  EXPECT_NEAR(axis.placeOf(10.0), 120.0, 1e-9);
  EXPECT_NEAR(axis.placeOf(100.0), 220.0, 1e-9);
  EXPECT_NEAR(LogAxis(1.0, 100.0, 200.0, 0.0).placeOf(10.0), 100.0, 1e-9);  // upwards on a screen
}

TEST(LogAxis, MarksOneTwoAndFiveOrTheDecades) {
  EXPECT_THAT(LogAxis(0.5, 20.0, 0, 1).marks(),
              ElementsAre(near(0.5), near(1), near(2), near(5), near(10), near(20)));
  EXPECT_THAT(LogAxis(0.02, 90.0, 0, 1).marks(), ElementsAre(near(0.1), near(1), near(10)));
  EXPECT_THAT(LogAxis(3.0, 4.0, 0, 1).marks(), IsEmpty());
}

TEST(LogAxis, PutsASingleNumberInTheMiddle) {
  EXPECT_EQ(LogAxis(5.0, 5.0, 0.0, 10.0).placeOf(5.0), 5.0);
}

}  // namespace
}  // namespace gyre
