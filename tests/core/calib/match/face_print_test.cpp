// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/face_print.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/calib/targets/standard_targets.h"

namespace gyre {
namespace {

Target oneFace() {
  Target target;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      target.corners.push_back(
          {static_cast<int>(target.corners.size()), {10.0 * column, -10.0 * row, 0.0}});
    }
  }
  target.faces = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  return target;
}

Eigen::Vector3d middleOf(const PrintedArea& area) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : area.outline_in_target) sum += point;
  return sum / static_cast<double>(area.outline_in_target.size());
}

bool hasSquareAt(const std::vector<PrintedArea>& areas, double x_mm, double y_mm) {
  return std::any_of(areas.begin(), areas.end(), [&](const PrintedArea& area) {
    return area.dark && (middleOf(area) - Eigen::Vector3d(x_mm, y_mm, 0.0)).norm() < 1e-9;
  });
}

TEST(FacePrint, TheSquareFromTheFirstCornerTowardsTheLastIsDark) {
  const Target target = oneFace();
  const auto areas = printOf(target, facesOf(target).at(0));
  EXPECT_EQ(areas.size(), 10U);  // half of 5 x 4
  EXPECT_TRUE(hasSquareAt(areas, 5.0, -5.0));
  EXPECT_FALSE(hasSquareAt(areas, 15.0, -5.0));
  EXPECT_TRUE(hasSquareAt(areas, 15.0, -15.0));
  EXPECT_TRUE(hasSquareAt(areas, -5.0, 5.0));  // beyond the first corner
}

TEST(FacePrint, TheListsOrderDecides) {
  Target target = oneFace();
  // From the upper right corner to the lower left one.
  std::swap(target.faces[0].front(), target.faces[0][3]);
  std::swap(target.faces[0].back(), target.faces[0][8]);
  const auto areas = printOf(target, facesOf(target).at(0));
  EXPECT_TRUE(hasSquareAt(areas, 25.0, -5.0));
  EXPECT_TRUE(hasSquareAt(areas, 5.0, -5.0));
  target.faces[0] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, 11};  // from the second corner
  EXPECT_TRUE(hasSquareAt(printOf(target, facesOf(target).at(0)), 15.0, -5.0));
}

TEST(FacePrint, AMarkHasTheOtherColourThanItsSquare) {
  Target target = oneFace();
  target.dots = {{{5.0, -5.0, 0.0}, 4.0}, {{15.0, -5.0, 0.0}, 4.0}, {{5.0, -5.0, 30.0}, 4.0}};
  const auto areas = printOf(target, facesOf(target).at(0));
  ASSERT_EQ(areas.size(), 12U);  // the third lies on another face
  EXPECT_FALSE(areas[10].dark);
  EXPECT_TRUE(areas[11].dark);
  for (const Eigen::Vector3d& point : areas[10].outline_in_target) {
    EXPECT_NEAR((point - Eigen::Vector3d(5.0, -5.0, 0.0)).norm(), 2.0, 1e-9);
  }
}

TEST(FacePrint, TheCubesDotIsDrawnOnItsTopAlone) {
  const Target cube = standardTarget("cube")->target;
  for (const TargetFace& face : facesOf(cube)) {
    const auto areas = printOf(cube, face);
    const auto dots = std::count_if(areas.begin(), areas.end(), [](const PrintedArea& area) {
      return area.outline_in_target.size() > 4;
    });
    EXPECT_EQ(dots, face.outwardInTarget().z() > 0.9 ? 1 : 0) << face.index;
  }
}

TEST(FacePrint, LeavesFacesWithMarkersAlone) {
  const Target wedge = standardTarget("wedge")->target;
  EXPECT_TRUE(printOf(wedge, facesOf(wedge).at(0)).empty());
}

}  // namespace
}  // namespace gyre
