// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/standard_targets.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace gyre {
namespace {

using Eigen::Vector3d;

class EveryTarget : public testing::TestWithParam<std::string> {
 protected:
  StandardTarget made() const { return standardTarget(GetParam()).value(); }
};

TEST_P(EveryTarget, StandsInTheMiddleOfASmallPlatter) {
  const StandardTarget target = made();
  EXPECT_EQ(target.target.name, GetParam());
  EXPECT_FALSE(target.title.empty());
  EXPECT_FALSE(target.steps.empty());
  Eigen::AlignedBox3d box;
  for (const TargetPoint& point : pointsOf(target.target)) box.extend(point.position_in_target);
  EXPECT_GE(box.min().z(), 0.0);
  EXPECT_LT(box.min().z(), 25.0);
  EXPECT_LT(box.center().head<2>().norm(), 5.0);
  // The larger rings are for larger platters.
  if (GetParam().starts_with("ring-")) return;
  for (const TargetPoint& point : pointsOf(target.target)) {
    EXPECT_LT(point.position_in_target.head<2>().norm(), 60.0);
  }
}

TEST_P(EveryTarget, HasPlaneFacesWhosePrintLooksOutward) {
  const Target target = made().target;
  const auto points = pointsOf(target);
  ASSERT_EQ(target.page_axes.size(), target.faces.size());
  for (std::size_t face = 0; face < target.faces.size(); ++face) {
    const PageAxes& axes = target.page_axes[face];
    const Vector3d outward = axes.down_in_target.cross(axes.right_in_target);
    EXPECT_NEAR(outward.norm(), 1.0, 1e-12);
    EXPECT_GT(outward.z(), -1e-9);  // the base carries no print
    double height = 0.0;
    int members = 0;
    for (const TargetPoint& point : points) {
      if (point.face != static_cast<int>(face)) continue;
      if (members++ == 0) height = outward.dot(point.position_in_target);
      EXPECT_NEAR(outward.dot(point.position_in_target), height, 1e-9);
    }
    EXPECT_GT(members, 15);
    // The rest of the target lies behind the face.
    for (const TargetPoint& point : points) {
      EXPECT_LT(outward.dot(point.position_in_target), height + 1e-9);
    }
  }
}

// Clockwise seen from outside: the corners turn against the outward normal.
TEST_P(EveryTarget, ListsMarkerCornersClockwiseFromOutside) {
  const Target target = made().target;
  for (const TargetPoint& point : pointsOf(target)) {
    if (point.marker_id >= 0 && !target.faces.empty()) {
      EXPECT_GE(point.face, 0);
    }
  }
  for (const TargetMarker& marker : target.markers) {
    const auto& at = marker.corners_in_target;
    const Vector3d inward = (at[1] - at[0]).cross(at[3] - at[0]);
    EXPECT_LE(inward.z(), 1e-9);
    EXPECT_NEAR((at[1] - at[0]).norm(), (at[3] - at[0]).norm(), 1e-9);
    EXPECT_NEAR((at[1] - at[0] + at[3] - at[2]).norm(), 0.0, 1e-9);
  }
}

// The sheet is folded, not stretched: distances on a face are those on the page.
TEST_P(EveryTarget, HasTheSizesThatArePrinted) {
  const StandardTarget target = made();
  if (target.target.faces.empty()) return;
  const auto first = static_cast<std::size_t>(target.target.faces[0][0]);
  const double step = (target.target.corners[first + 1].position_in_target -
                       target.target.corners[first].position_in_target)
                          .norm();
  double narrowest = 1e9;
  for (const PrintPolygon& polygon : target.net.polygons) {
    if (polygon.ink == PrintPolygon::Ink::kBlack && polygon.outline.size() == 4) {
      const double side = (polygon.outline[1] - polygon.outline[0]).norm();
      if (std::abs(side - step) < 1e-9) narrowest = std::min(narrowest, side);
    }
    for (const Eigen::Vector2d& point : polygon.outline) {
      EXPECT_GE(point.minCoeff(), 0.0);
      EXPECT_LE((point - target.net.size).maxCoeff(), 0.0);
    }
  }
  EXPECT_NEAR(narrowest, step, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Targets, EveryTarget, testing::ValuesIn(standardTargetNames()),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

TEST(StandardTargets, ShareNoMarkerSoThatNoneIsTakenForAnother) {
  std::set<int> ids;
  std::size_t count = 0;
  for (const std::string& name : standardTargetNames()) {
    const StandardTarget made = standardTarget(name).value();
    for (const TargetMarker& marker : made.target.markers) {
      ids.insert(marker.id);
      ++count;
    }
  }
  EXPECT_EQ(ids.size(), count);
  EXPECT_EQ(*ids.begin(), 0);
  EXPECT_LT(*ids.rbegin(), 250);
}

TEST(StandardTargets, WedgeRisesByFortyDegrees) {
  const PageAxes axes = standardTarget("wedge")->target.page_axes.at(0);
  const Vector3d outward = axes.down_in_target.cross(axes.right_in_target);
  EXPECT_NEAR(outward.z(), std::cos(40.0 * 3.14159265358979 / 180.0), 1e-9);
}

// The dot stands on the top alone and in no place that a turn of the cube maps onto itself.
TEST(StandardTargets, CubeIsToldApartByItsDot) {
  const Target cube = standardTarget("cube")->target;
  ASSERT_EQ(cube.dots.size(), 1U);
  EXPECT_NEAR(cube.dots[0].centre_in_target.z(), 50.0, 1e-9);
  EXPECT_GT(cube.dots[0].centre_in_target.head<2>().norm(), 3.0);
  EXPECT_TRUE(cube.markers.empty());
  EXPECT_EQ(cube.corners.size(), 125U);
}

TEST(StandardTargets, NamesThoseThereAre) {
  const auto none = standardTarget("sphere");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().sentence(), testing::HasSubstr("wedge"));
}

}  // namespace
}  // namespace gyre
