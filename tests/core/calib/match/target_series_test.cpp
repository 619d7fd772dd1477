// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_series.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"
#include "tests/support/rendered_target.h"

namespace gyre {
namespace {

Target cubeWithoutMark() {
  Target cube = standardTarget("cube")->target;
  cube.dots.clear();
  return cube;
}

SeriesPicture pictureAt(double table_angle_deg, double commanded_deg) {
  return {"picture", radFromDeg(commanded_deg), [=]() -> Result<cv::Mat> {
            test::TargetScene scene;
            scene.noise = 2.0;
            return test::renderTarget(
                cubeWithoutMark(), test::plainCamera(640, 480),
                test::lookAtTarget(260.0, radFromDeg(35.0), radFromDeg(table_angle_deg + 5.0)),
                scene);
          }};
}

double turnedBetween(const FoundTarget& a, const FoundTarget& b) {
  return degFromRad(
      Eigen::AngleAxisd(a.cam_from_target->rotation.transpose() * b.cam_from_target->rotation)
          .angle());
}

TEST(TargetSeries, NamesASymmetricCubeAlikeThoughTheMotorTurnsBackwardsAndTooFar) {
  std::vector<SeriesPicture> pictures;
  for (int step = 0; step < 10; ++step) {
    pictures.push_back(pictureAt(-24.0 * step, 20.0 * step));
  }
  const auto found = findTargets(pictures, cubeWithoutMark());
  ASSERT_TRUE(found) << found.error().sentence();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    ASSERT_TRUE((*found)[i]) << i << ": " << (*found)[i].error().sentence();
    const FoundTarget& now = *(*found)[i];
    EXPECT_EQ(now.view.table_angle_rad, pictures[i].table_angle_rad);
    if (i == 0) continue;
    EXPECT_NEAR(turnedBetween(*(*found)[i - 1], now), 24.0, 1.0) << i;
  }
}

TEST(TargetSeries, FollowsAWideStepOnceItKnowsTheAxis) {
  std::vector<SeriesPicture> pictures = {pictureAt(0, 0), pictureAt(20, 20), pictureAt(140, 140)};
  const auto found = findTargets(pictures, cubeWithoutMark());
  ASSERT_TRUE(found) << found.error().sentence();
  ASSERT_TRUE((*found)[2]) << (*found)[2].error().sentence();
  EXPECT_NEAR(turnedBetween(*(*found)[1], *(*found)[2]), 120.0, 1.0);
}

TEST(TargetSeries, GoesOnAfterAPictureWithoutATarget) {
  std::vector<SeriesPicture> pictures = {pictureAt(0, 0), pictureAt(10, 10), pictureAt(20, 20)};
  pictures[1].open = []() -> Result<cv::Mat> {
    return cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90));
  };
  const auto found = findTargets(pictures, cubeWithoutMark());
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_FALSE((*found)[1]);
  ASSERT_TRUE((*found)[2]);
  EXPECT_NEAR(turnedBetween(*(*found)[0], *(*found)[2]), 20.0, 1.0);
}

TEST(TargetSeries, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const auto found = findTargets({pictureAt(0, 0)}, cubeWithoutMark(), {}, Task(stop.get_token()));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
