// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/formatted.h"

#include <clocale>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/support/comma_locale.h"

namespace gyre {
namespace {

TEST(Formatted, WritesAsPrintfDoes) {
  EXPECT_EQ(formatted("view_%04d.png", 7), "view_0007.png");
  EXPECT_EQ(formatted("%.2f px%s", 0.126, "."), "0.13 px.");
  EXPECT_EQ(formatted("nothing to fill in"), "nothing to fill in");
  EXPECT_EQ(formatted("%s", ""), "");
}

TEST(Formatted, CutsNothingOff) {
  const std::string longer(5000, 'x');
  EXPECT_EQ(formatted("%s!", longer.c_str()), longer + "!");
}

TEST(Formatted, KeepsTheDecimalPointWhereACommaIsUsual) {
  const test::CommaLocale germany;
  ASSERT_TRUE(germany.made());
  ASSERT_NE(std::setlocale(LC_ALL, ""), nullptr);
  char usual[16];
  std::snprintf(usual, sizeof usual, "%.1f", 0.5);
  const std::string ours = formatted("%.1f %g", 0.5, 12500.25);
  char after[16];
  std::snprintf(after, sizeof after, "%.1f", 0.5);
  std::setlocale(LC_ALL, "C");
  EXPECT_STREQ(usual, "0,5");  // or nothing was tried
  EXPECT_EQ(ours, "0.5 12500.2");
  EXPECT_STREQ(after, "0,5");  // and the caller's own words stay as they were
}

TEST(PxText, TellsTwoDigitsOfWhatIsSmall) {
  EXPECT_EQ(pxText(0.4231), "0.42 px");
  EXPECT_EQ(pxText(3.0), "3.0 px");
  EXPECT_EQ(pxText(3.21), "3.2 px");
  EXPECT_EQ(pxText(17.4), "17 px");
  EXPECT_EQ(pxText(120.0), "120 px");
  EXPECT_EQ(pxText(0.0), "0 px");
}

}  // namespace
}  // namespace gyre
