// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/calibration_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/turned_target.h"

namespace gyre {
namespace {

using test::TurnedTarget;
using testing::HasSubstr;

RigBundleOptions defaultOptions() {
  RigBundleOptions options;
  options.image_width_px = 1280;
  options.image_height_px = 960;
  return options;
}

TEST(CheckCalibration, MeasuresASecondTargetInMillimetres) {
  const TurnedTarget second(test::cubeTarget());
  const auto check = checkCalibration(second.truth, second.views(1), second.target, Task{});
  ASSERT_TRUE(check) << check.error().sentence();
  // 0.05 px are 0.007 mm here; some ten looks at each point leave a third of that in each
  // direction.
  EXPECT_LT(check->error_mm, 0.01);
  EXPECT_LT(std::abs(check->size_share), 1e-4);
  EXPECT_GT(check->points, 100U);
}

TEST(CheckCalibration, TellsASizeThatIsWrong) {
  TurnedTarget second(test::cubeTarget());
  for (Eigen::Vector3d& x : second.true_points) x *= 1.01;
  const auto check = checkCalibration(second.truth, second.views(1), second.target, Task{});
  ASSERT_TRUE(check) << check.error().sentence();
  // The axis stands still, so that its distance carries the scale; the target's place is free.
  EXPECT_NEAR(check->size_share, 0.01, 0.002);
  EXPECT_GT(check->error_mm, 5.0 * check->detail_mm);
}

TEST(CheckCalibration, TellsACentreThatIsWrong) {
  const TurnedTarget second(test::cubeTarget());
  const auto right = checkCalibration(second.truth, second.views(1), second.target, Task{});
  Calibration wrong = second.truth;
  wrong.camera.cx += 4.0;
  const auto check = checkCalibration(wrong, second.views(1), second.target, Task{});
  ASSERT_TRUE(right && check);
  EXPECT_GT(check->error_mm, 3.0 * right->error_mm);
}

TEST(CheckCalibration, TakesHeldOutCorners) {
  const TurnedTarget turned(test::wedgeTarget());
  const auto [kept, held] = holdOut(turned.views(2), 4);
  const auto found = calibrateRig(kept, turned.target, defaultOptions(), Task{});
  ASSERT_TRUE(found);
  const auto check = checkCalibration(found->calibration, held, turned.target, Task{});
  ASSERT_TRUE(check) << check.error().sentence();
  EXPECT_LT(check->error_mm, 0.02);
}

TEST(CheckCalibration, RefusesWithoutTableAndWithoutPictures) {
  const TurnedTarget second(test::cubeTarget());
  Calibration hand_held = second.truth;
  hand_held.cam_from_table.reset();
  EXPECT_FALSE(checkCalibration(hand_held, second.views(1), second.target, Task{}));
  EXPECT_FALSE(checkCalibration(second.truth, {}, second.target, Task{}));
}

// A ring that stays on the platter, and the calibration made with it.
class Place : public testing::Test {
 protected:
  Place() : turned_(test::ringTarget(12, 55.0, 12.0)) {
    known_.calibration = turned_.truth;
    known_.table_from_target = turned_.table_from_target;
    known_.target = turned_.target;
  }

  TurnedTarget turned_;
  RigCalibration known_;
};

TEST_F(Place, FitsWhenNothingMovedWhateverTheAngle) {
  turned_.true_rad = {1.234};
  turned_.commanded_rad = {0.0};
  const auto check = checkPlace(known_, turned_.views(1)[0]);
  ASSERT_TRUE(check) << check.error().sentence();
  EXPECT_TRUE(check->fits);
  EXPECT_LT(check->offset_px, 0.1);
  EXPECT_NEAR(check->angle_rad, 1.234, 1e-3);
}

TEST_F(Place, TellsThatTheCameraWasBumped) {
  const Rigid3 bump{Eigen::AngleAxisd(radFromDeg(0.2), Eigen::Vector3d::UnitX()).toRotationMatrix(),
                    {0.0, 0.0, 0.0}};
  turned_.truth.cam_from_table = bump * *turned_.truth.cam_from_table;
  const auto check = checkPlace(known_, turned_.views(1)[0]);
  ASSERT_TRUE(check) << check.error().sentence();
  EXPECT_FALSE(check->fits);
  // 0.2 deg are 8.4 px at 2400 px, and 1.2 mm at 350 mm; no angle of the table hides them.
  EXPECT_NEAR(check->offset_px, 8.4, 2.5);
  EXPECT_NEAR(check->offset_mm, 1.2, 0.4);
  EXPECT_THAT(check->sentence, HasSubstr("moved"));
}

TEST_F(Place, RefusesAPictureThatShowsNothing) {
  EXPECT_FALSE(checkPlace(known_, TargetView{"empty", 0.0, {}}));
}

TEST_F(Place, ComesBackWithOneTurnOfTheRing) {
  const Rigid3 bump{
      Eigen::AngleAxisd(radFromDeg(3.0), Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      {5.0, -3.0, 10.0}};
  turned_.truth.cam_from_table = bump * *turned_.truth.cam_from_table;
  RigBundleOptions options = defaultOptions();
  options.shape = TargetShape::kExact;
  options.fixed_camera = turned_.truth.camera;
  const auto found = calibrateRig(turned_.views(1), turned_.target, options, Task{});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->calibration.camera.fx, turned_.truth.camera.fx);
  // Up to a turn about the axis, which the x axis towards the camera fixes anew.
  const Eigen::Vector3d axis = turned_.truth.cam_from_table->rotation.col(2);
  EXPECT_LT(axis.cross(found->calibration.cam_from_table->rotation.col(2)).norm(), 2e-4);
  EXPECT_LT(
      (found->calibration.cam_from_table->translation - turned_.truth.cam_from_table->translation)
          .norm(),
      0.1);
}

}  // namespace
}  // namespace gyre
