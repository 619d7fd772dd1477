// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/median.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(Median, IsTheMiddleOne) { EXPECT_EQ(median(std::vector{9.0, 1.0, 4.0}), 4.0); }

TEST(Median, IsTheUpperOfTheTwoInTheMiddle) {
  EXPECT_EQ(median(std::vector{4.0F, 1.0F, 3.0F, 2.0F}), 3.0F);
}

TEST(Median, OfOneIsThatOne) { EXPECT_EQ(median(std::vector{7}), 7); }

TEST(Quantile, ReachesBothEnds) {
  const std::vector values = {5, 3, 1, 2, 4};
  EXPECT_EQ(quantile(values, 0.0), 1);
  EXPECT_EQ(quantile(values, 1.0), 5);
  EXPECT_EQ(quantile(values, 0.25), 2);
}

TEST(QuantileDeathTest, OfNothingIsABug) {
  EXPECT_DEATH((void)median(std::vector<double>{}), "empty");
}

}  // namespace
}  // namespace gyre
