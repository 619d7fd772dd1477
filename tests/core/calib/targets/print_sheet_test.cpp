// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/print_sheet.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

constexpr double kRim_mm = 8.0;

void expectOnPage(const Eigen::Vector2d& point, const PageSize& page, const std::string& what) {
  EXPECT_GE(point.x(), kRim_mm) << what;
  EXPECT_GE(point.y(), kRim_mm) << what;
  EXPECT_LE(point.x(), page.width_mm - kRim_mm) << what;
  EXPECT_LE(point.y(), page.height_mm - kRim_mm) << what;
}

TEST(PrintSheet, FitsEveryTargetOnBothPages) {
  for (const PageSize& page : {kA4, kLetter}) {
    for (const std::string& name : standardTargetNames()) {
      const PrintDrawing sheet = sheetOf(*standardTarget(name), page);
      for (const PrintPolygon& polygon : sheet.polygons) {
        for (const auto& point : polygon.outline) expectOnPage(point, page, name);
      }
      for (const PrintLine& line : sheet.lines) {
        expectOnPage(line.from, page, name);
        expectOnPage(line.to, page, name);
      }
      for (const PrintText& text : sheet.texts) {
        expectOnPage(text.top_left, page, name + ": " + text.words);
        expectOnPage(text.top_left + text.size, page, name + ": " + text.words);
      }
    }
  }
}

TEST(PrintSheet, CarriesARulerEachWayClearOfTheNet) {
  for (const PageSize& page : {kA4, kLetter}) {
    for (const std::string& name : standardTargetNames()) {
      const StandardTarget target = *standardTarget(name);
      const PrintDrawing sheet = sheetOf(target, page);
      ASSERT_EQ(sheet.rulers.size(), 2U);
      EXPECT_NEAR((sheet.rulers[0].to - sheet.rulers[0].from - Eigen::Vector2d(100, 0)).norm(), 0,
                  1e-12);
      EXPECT_NEAR((sheet.rulers[1].to - sheet.rulers[1].from - Eigen::Vector2d(0, 100)).norm(), 0,
                  1e-12);
      double left = 1e9;
      double bottom = 0.0;
      for (const PrintLine& line : sheet.lines) {
        if (line.kind == PrintLine::Kind::kRuler) continue;
        left = std::min({left, line.from.x(), line.to.x()});
        bottom = std::max({bottom, line.from.y(), line.to.y()});
      }
      EXPECT_GT(left, sheet.rulers[1].from.x() + 5.0) << name;
      EXPECT_LT(bottom, sheet.rulers[0].from.y() - 5.0) << name;
    }
  }
}

TEST(PrintSheet, KnowsItsPages) {
  EXPECT_EQ(pageSize("A4")->width_mm, 210.0);
  EXPECT_EQ(pageSize("letter")->height_mm, 279.4);
  EXPECT_FALSE(pageSize("a3"));
}

}  // namespace
}  // namespace gyre
