// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(Random, IsTheSameForTheSameSeed) {
  Random a(7);
  Random b(7);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.next(), b.next());
}

TEST(Random, GaussianHasUnitSpread) {
  Random random(1);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.gaussian();
    sum += value;
    sum_of_squares += value * value;
  }
  // Five standard deviations of either statistic over 100 000 draws.
  EXPECT_NEAR(sum / kCount, 0.0, 0.016);
  EXPECT_NEAR(sum_of_squares / kCount, 1.0, 0.023);
}

TEST(Random, UniformStaysInItsInterval) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(-2.0, 3.0);
    EXPECT_GE(value, -2.0);
    EXPECT_LT(value, 3.0);
    EXPECT_LT(random.below(5), 5U);
  }
}

TEST(HashWords, DependsOnOrderAndEveryWord) {
  EXPECT_NE(hashWords({1, 2}), hashWords({2, 1}));
  EXPECT_NE(hashWords({1, 2}), hashWords({1, 3}));
  EXPECT_NE(hashWords({0}), hashWords({0, 0}));
}

}  // namespace
}  // namespace gyre
