// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sheet_print.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

// Four by four squares of 10 mm, the one at the upper left dark, with a code in the bright one
// beside it and a dot in the next dark one.
SheetPrint sheet() {
  SheetPrint print(Vector2d(25, 25));
  SquareLattice lattice;
  lattice.origin = {-20, -20};
  lattice.step = 10.0 * Eigen::Matrix2d::Identity();
  lattice.last = {3, 3};
  print.set(lattice);
  SheetCode code;
  code.origin = {-8, -18};
  code.module = 2.0 * Eigen::Matrix2d::Identity();
  code.modules_a_side = 3;
  code.modules = {0, 0, 0, 0, 1, 0, 0, 0, 0};
  print.add(code);
  print.add(SheetDot{{5, -15}, 2.0});
  return print;
}

TEST(SheetPrint, PaintsSquaresCodesAndDots) {
  const SheetPrint print = sheet();
  EXPECT_TRUE(print.isDark({-15, -15}));
  EXPECT_FALSE(print.isDark({-9, -19}));  // beside the code
  EXPECT_TRUE(print.isDark({-7, -17}));   // its border
  EXPECT_FALSE(print.isDark({-5, -15}));  // its white module
  EXPECT_TRUE(print.isDark({2, -15}));
  EXPECT_FALSE(print.isDark({5, -15}));  // the dot
  EXPECT_FALSE(print.isDark({-22, -15}));
  EXPECT_FALSE(print.isDark({100, 100}));
}

// Nothing changes colour within the clearance.
TEST(SheetPrint, NeverClaimsMoreClearanceThanThereIs) {
  const SheetPrint print = sheet();
  Random random(5);
  int clear = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2f at(static_cast<float>(random.uniform(-24, 24)),
                      static_cast<float>(random.uniform(-24, 24)));
    const float clearance = print.clearance(at);
    ASSERT_LE(clearance, SheetPrint::kReach_mm);
    clear += clearance > 0.3F ? 1 : 0;
    const double angle = random.uniform(0, 6.3);
    const float off = 0.99F * clearance * static_cast<float>(random.uniform());
    const Vector2f other = at + off * Vector2f(static_cast<float>(std::cos(angle)),
                                               static_cast<float>(std::sin(angle)));
    ASSERT_EQ(print.isDark(at), print.isDark(other)) << at.transpose();
  }
  EXPECT_GT(clear, 10000);
}

}  // namespace
}  // namespace gyre
