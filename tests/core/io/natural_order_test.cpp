// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace gyre {
namespace {

TEST(NaturalOrder, CountsAsPeopleDo) {
  std::vector<std::string> names = {"v101.png", "v3.png", "v1.png", "v20.png", "a", "v2b.png"};
  std::sort(names.begin(), names.end(), NaturalOrder());
  EXPECT_EQ(names,
            (std::vector<std::string>{"a", "v1.png", "v2b.png", "v3.png", "v20.png", "v101.png"}));
}

TEST(NaturalOrder, LeadingZerosDoNotChangeTheNumber) {
  EXPECT_TRUE(NaturalOrder()("v009", "v10"));
  EXPECT_TRUE(NaturalOrder()("v9", "v0010"));
  EXPECT_TRUE(NaturalOrder()("000", "1"));
}

TEST(NaturalOrder, NumbersMayBeOfAnyLength) {
  EXPECT_TRUE(NaturalOrder()(std::string(99, '9'), "1" + std::string(99, '0')));
}

TEST(NaturalOrder, IsAStrictTotalOrder) {
  const std::vector<std::string> names = {"",   "1",   "01",  "001",  "1a", "01a",
                                          "a1", "a01", "a1b", "a01b", "é",  "a10"};
  for (const auto& a : names) {
    for (const auto& b : names) {
      EXPECT_EQ(NaturalOrder()(a, b) || NaturalOrder()(b, a), a != b) << a << " " << b;
      EXPECT_FALSE(NaturalOrder()(a, b) && NaturalOrder()(b, a)) << a << " " << b;
    }
  }
}

}  // namespace
}  // namespace gyre
