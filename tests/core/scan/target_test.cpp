// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

// Two squares at right angles, with a marker on the upright one and one that lies on neither.
Target corneredTarget() {
  Target target;
  target.name = "corner";
  target.dictionary = "DICT_5X5_250";
  target.corners = {{10, {0, 0, 0}}, {11, {20, 0, 0}}, {12, {0, 20, 0}}, {13, {20, 20, 0}},
                    {20, {0, 0, 0}}, {21, {20, 0, 0}}, {22, {0, 0, 20}}, {23, {20, 0, 20}}};
  target.faces = {{10, 11, 12, 13}, {20, 21, 22, 23}};
  using Eigen::Vector3d;
  target.markers = {
      {7, {Vector3d(2, 0, 12), Vector3d(8, 0, 12), Vector3d(8, 0, 6), Vector3d(2, 0, 6)}},
      {8, {Vector3d(2, 5, 12), Vector3d(8, 5, 12), Vector3d(8, 5, 6), Vector3d(2, 5, 6)}}};
  return target;
}

TEST(PointsOfTarget, ListsCornersThenFourAMarker) {
  const auto points = pointsOf(corneredTarget());
  ASSERT_EQ(points.size(), 8U + 2U * 4U);
  EXPECT_EQ(points[0].corner_id, 10);
  EXPECT_EQ(points[7].corner_id, 23);
  EXPECT_EQ(points[8].marker_id, 7);
  EXPECT_EQ(points[8].corner_id, -1);
  EXPECT_EQ(points[11].position_in_target, Eigen::Vector3d(2, 0, 6));
}

TEST(PointsOfTarget, PutsAMarkerOnTheFaceInWhosePlaneItLies) {
  const auto points = pointsOf(corneredTarget());
  EXPECT_EQ(points[0].face, 0);
  EXPECT_EQ(points[4].face, 1);
  EXPECT_EQ(points[8].face, 1);
  EXPECT_EQ(points[12].face, -1) << "5 mm behind the face";
}

TEST(PointsOfTarget, PassesOverFacesThatNameUnknownCornersOrSpanNoPlane) {
  Target target = corneredTarget();
  target.faces = {{10, 11}, {99, 98, 97}};
  for (const TargetPoint& point : pointsOf(target)) EXPECT_LE(point.face, 0);
}

TEST(PointsOfTarget, IsEmptyForATargetWithNothingOnIt) { EXPECT_TRUE(pointsOf({}).empty()); }

TEST(WithPoints, MovesEachPointInItsOrder) {
  Target target;
  target.corners = {{7, {1.0, 2.0, 0.0}}};
  target.markers.emplace_back();
  std::vector<Eigen::Vector3d> moved;
  for (int i = 0; i < 5; ++i) moved.emplace_back(i, 2 * i, 3 * i);
  const auto points = pointsOf(withPoints(target, moved));
  ASSERT_EQ(points.size(), moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(points[i].position_in_target, moved[i]);
  }
  EXPECT_EQ(points[0].corner_id, 7);
}

}  // namespace
}  // namespace gyre
