// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/target_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

Target sheet() {
  Target target;
  target.name = "sheet";
  target.dictionary = "DICT_5X5_250";
  target.corners = {{0, {0, 0, 5}}, {1, {20, 0, 5}}, {2, {0, 20, 5}}, {3, {20, 20, 5}}};
  target.faces = {{0, 1, 2, 3}};
  target.page_axes = {{Vector3d::UnitX(), -Vector3d::UnitY()}};
  target.markers = {
      {7, {Vector3d(2, 8, 5), Vector3d(8, 8, 5), Vector3d(8, 2, 5), Vector3d(2, 2, 5)}}};
  return target;
}

void expectFault(const Target& target, const std::string& words) {
  const auto fault = faultOf(target);
  ASSERT_TRUE(fault.has_value()) << words;
  EXPECT_THAT(*fault, HasSubstr(words));
}

TEST(TargetCheck, FindsNothingWrongWithAGoodOne) { EXPECT_FALSE(faultOf(sheet()).has_value()); }

TEST(TargetCheck, AllowsHalfAMillimetreOfBow) {
  Target target = sheet();
  target.corners[3].position_in_target.z() += 1.0;  // 0.25 mm off the plane that fits best
  EXPECT_FALSE(faultOf(target).has_value());
  target.corners[3].position_in_target.z() += 3.0;
  expectFault(target, "not in a plane");
}

TEST(TargetCheck, WantsItsBaseOnTheTable) {
  Target target = sheet();
  target.corners[0].position_in_target.z() = -8.0;
  target.faces.clear();
  target.page_axes.clear();
  expectFault(target, "z = -8 mm");
  target = sheet();
  for (TargetCorner& corner : target.corners) corner.position_in_target.z() = 300.0;
  target.markers.clear();
  expectFault(target, "z = 300 mm");
}

TEST(TargetCheck, RefusesMarkersThatAreNone) {
  Target target = sheet();
  target.dictionary = "DICT_9X9_7";
  expectFault(target, "DICT_9X9_7");
  target = sheet();
  target.markers[0].id = 250;
  expectFault(target, "does not hold");
  target = sheet();
  target.markers.push_back(target.markers[0]);
  expectFault(target, "marker 7 twice");
  target = sheet();
  target.markers[0].corners_in_target[2].x() += 1.0;
  expectFault(target, "no square");
  target = sheet();
  target.markers[0].corners_in_target.fill(Vector3d(1, 1, 5));
  expectFault(target, "no square");
}

TEST(TargetCheck, RefusesFacesThatDoNotAddUp) {
  Target target = sheet();
  target.faces[0].push_back(9);
  expectFault(target, "corner 9 on face 1");
  target = sheet();
  target.faces[0].push_back(0);
  expectFault(target, "more than once");
  target = sheet();
  target.faces[0] = {0, 1};
  expectFault(target, "less than three");
  target = sheet();
  target.corners[1].id = 0;
  expectFault(target, "corner 0 twice");
  target = sheet();
  target.page_axes.push_back(target.page_axes[0]);
  expectFault(target, "page_axes");
  target = sheet();
  target.page_axes[0].down_in_target = Vector3d::UnitX();
  expectFault(target, "right angle");
}

TEST(TargetCheck, RefusesATargetWithoutPoints) { expectFault({}, "neither corners nor markers"); }

}  // namespace
}  // namespace gyre
