// The newest value wins, and the reader is told once.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/latest.h"

#include <gtest/gtest.h>

#include <thread>

namespace gyre {
namespace {

TEST(Latest, KeepsTheNewestAndTellsOnce) {
  Latest<int> box;
  EXPECT_TRUE(box.put(1));
  EXPECT_FALSE(box.put(2));
  EXPECT_EQ(box.take(), 2);
  EXPECT_EQ(box.take(), std::nullopt);
  EXPECT_TRUE(box.put(3));
}

TEST(Latest, NeverLosesTheLastValueAcrossThreads) {
  Latest<int> box;
  constexpr int kLast = 10000;
  int seen = 0;
  std::jthread writer([&] {
    for (int i = 1; i <= kLast; ++i) (void)box.put(i);
  });
  while (seen < kLast) {
    if (const auto value = box.take()) {
      EXPECT_GT(*value, seen);
      seen = *value;
    }
  }
}

}  // namespace
}  // namespace gyre
