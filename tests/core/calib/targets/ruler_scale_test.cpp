// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/ruler_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

Target sheet() {
  Target target;
  target.corners = {{0, {0, 0, 0}}, {1, {20, 0, 0}}, {2, {0, 30, 0}}, {3, {20, 30, 0}}};
  target.faces = {{0, 1, 2, 3}};
  target.page_axes = {{{1, 0, 0}, {0, -1, 0}}};
  return target;
}

double between(const Target& target, std::size_t a, std::size_t b) {
  return (target.corners[a].position_in_target - target.corners[b].position_in_target).norm();
}

TEST(RulerScale, StretchesEachDirectionOfThePageByItsOwnRuler) {
  const auto scaled = scaledByRulers(sheet(), {97.0, 101.0, 100.0});
  ASSERT_TRUE(scaled.ok());
  EXPECT_NEAR(between(*scaled, 0, 1), 20.0 * 0.97, 1e-12);
  EXPECT_NEAR(between(*scaled, 0, 2), 30.0 * 1.01, 1e-12);
}

TEST(RulerScale, StretchesEvenlyWhatWasNotPrintedByUs) {
  Target target = sheet();
  target.page_axes.clear();
  const auto scaled = scaledByRulers(target, {97.0, 97.0, 100.0});
  ASSERT_TRUE(scaled.ok());
  EXPECT_NEAR(between(*scaled, 0, 3), between(target, 0, 3) * 0.97, 1e-12);
}

TEST(RulerScale, LeavesAnExactPrintAsItIs) {
  const auto scaled = scaledByRulers(sheet(), {});
  ASSERT_TRUE(scaled.ok());
  EXPECT_EQ(scaled->corners[3].position_in_target, sheet().corners[3].position_in_target);
}

TEST(RulerScale, RefusesWhatNoPrinterDoes) {
  EXPECT_FALSE(scaledByRulers(sheet(), {50.0, 100.0, 100.0}).ok());
  EXPECT_FALSE(scaledByRulers(sheet(), {100.0, -1.0, 100.0}).ok());
  EXPECT_FALSE(scaledByRulers(sheet(), {100.0, std::nan(""), 100.0}).ok());
}

}  // namespace
}  // namespace gyre
