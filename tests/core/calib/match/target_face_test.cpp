// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_face.h"

#include <gtest/gtest.h>

#include "core/calib/targets/standard_targets.h"

namespace gyre {
namespace {

class FacesOfStandardTargets : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Names, FacesOfStandardTargets,
                         testing::Values("cube", "coded-cube", "wedge"), [](const auto& trial) {
                           std::string name = trial.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(FacesOfStandardTargets, AreDrawnAsSeenFromOutside) {
  const Target target = standardTarget(GetParam())->target;
  const auto points = pointsOf(target);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const TargetPoint& point : points) middle += point.position_in_target;
  middle /= static_cast<double>(points.size());
  const auto faces = facesOf(target);
  ASSERT_EQ(faces.size(), target.faces.size());
  for (const TargetFace& face : faces) {
    EXPECT_GT(face.outwardInTarget().dot(face.origin_in_target - middle), 0.0) << face.index;
    EXPECT_NEAR(face.outwardInTarget().norm(), 1.0, 1e-12);
    EXPECT_TRUE(face.grid) << face.index;
    for (const TargetFace::Corner& corner : face.corners) {
      const auto& position = points[static_cast<std::size_t>(corner.point)].position_in_target;
      EXPECT_LT((face.pointAt(corner.place_mm) - position).norm(), 1e-6);
      EXPECT_LT((face.placeOf(position) - corner.place_mm).norm(), 1e-6);
      EXPECT_TRUE(face.holds(position));
      EXPECT_FALSE(face.holds(position + face.outwardInTarget()));  // 1 mm in front of it
      EXPECT_GT(corner.clear_mm, 0.0);
    }
  }
}

// Six corners that people described, without page axes: no rows, no columns.
Target described(const std::vector<Eigen::Vector3d>& corners) {
  Target target;
  target.faces.emplace_back();
  for (const Eigen::Vector3d& corner : corners) {
    const int id = static_cast<int>(target.corners.size());
    target.corners.push_back({id, corner});
    target.faces.back().push_back(id);
  }
  return target;
}

TEST(TargetFace, HasNoGridWhenItsCornersAreNotInRows) {
  const auto faces =
      facesOf(described({{0, 0, 0}, {10, 1, 0}, {3, 9, 0}, {17, 5, 0}, {8, 14, 0}, {21, 19, 0}}));
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_FALSE(faces[0].grid);
  EXPECT_EQ(faces[0].corners.size(), 6U);
}

TEST(TargetFace, IsEmptyForTooFewCornersOrALine) {
  EXPECT_TRUE(facesOf(described({{0, 0, 0}, {10, 0, 0}})).front().corners.empty());
  EXPECT_TRUE(facesOf(described({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}})).front().corners.empty());
}

TEST(TargetFace, KnowsTheGapsOfItsGrid) {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      if (row == 1 && column == 2) continue;
      corners.emplace_back(10.0 * column, 12.0 * row, 0.0);
    }
  }
  const auto faces = facesOf(described(corners));
  ASSERT_TRUE(faces[0].grid);
  const FaceGrid& grid = *faces[0].grid;
  EXPECT_EQ(std::max(grid.columns, grid.rows), 5);
  EXPECT_EQ(std::min(grid.columns, grid.rows), 4);
  int gaps = 0;
  for (const int corner : grid.corner_of_cell) gaps += corner < 0 ? 1 : 0;
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(grid.cornerAt(-1, 0), -1);
  EXPECT_EQ(grid.cornerAt(0, grid.rows), -1);
}

}  // namespace
}  // namespace gyre
