// Times as people read them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/facts.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(ClockText, ShowsMinutesAndSeconds) {
  EXPECT_EQ(clockText(0.0), "0:00");
  EXPECT_EQ(clockText(65.4), "1:05");
  EXPECT_EQ(clockText(3599.6), "1:00:00");
  EXPECT_EQ(clockText(7265.0), "2:01:05");
}

TEST(ClockText, ShowsNothingNegative) { EXPECT_EQ(clockText(-3.0), "0:00"); }

}  // namespace
}  // namespace gyre
