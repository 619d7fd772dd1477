// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/from_clicks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"
#include "tests/support/rendered_target.h"

namespace gyre {
namespace {

struct ClickedCube {
  Target target = standardTarget("cube")->target;
  CameraModel camera = test::plainCamera(640, 480);
  Rigid3 cam_from_target = test::lookAtTarget(260.0, radFromDeg(35.0), radFromDeg(45.0));
  cv::Mat image;

  ClickedCube() {
    test::TargetScene scene;
    scene.noise = 2.0;
    image = test::renderTarget(target, camera, cam_from_target, scene);
  }

  // Two opposite corners on each of the faces that are seen, clicked by a hand that is off.
  std::vector<CornerClick> clicks(double off_px, std::uint64_t seed) const {
    Random random(seed);
    std::vector<CornerClick> clicks;
    for (const std::size_t face : {0, 1, 4}) {
      for (const int id : {target.faces[face].front(), target.faces[face].back()}) {
        const auto at = std::find_if(target.corners.begin(), target.corners.end(),
                                     [&](const auto& corner) { return corner.id == id; });
        const auto pixel = camera.project(cam_from_target * at->position_in_target);
        clicks.push_back(
            {id, *pixel + off_px * Eigen::Vector2d(random.gaussian(), random.gaussian())});
      }
    }
    return clicks;
  }

  double worstMiss(const FoundTarget& found) const {
    double worst = 0.0;
    for (const auto& sighting : found.view.sightings) {
      worst = std::max(worst, (sighting.pixel -
                               *test::truePixel(target, camera, cam_from_target, sighting.point))
                                  .norm());
    }
    return worst;
  }
};

TEST(FromClicks, FindsAllCornersFromSixExactClicks) {
  const ClickedCube cube;
  const auto found = targetFromClicks(cube.image, cube.target, cube.clicks(0.0, 1));
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_GE(found->view.sightings.size(), 72u);
  EXPECT_LT(cube.worstMiss(*found), 0.3);
  EXPECT_EQ(found->faces.size(), 3u);
}

TEST(FromClicks, FindsAllCornersFromClicksThatAreTwoPixelsOff) {
  const ClickedCube cube;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto found = targetFromClicks(cube.image, cube.target, cube.clicks(2.0, seed));
    ASSERT_TRUE(found) << seed << ": " << found.error().sentence();
    EXPECT_GE(found->view.sightings.size(), 70u) << seed;
    EXPECT_LT(cube.worstMiss(*found), 0.5) << seed;
  }
}

TEST(FromClicks, RefusesClicksOnWrongCorners) {
  const ClickedCube cube;
  auto clicks = cube.clicks(0.0, 1);
  std::swap(clicks[0].corner_id, clicks[3].corner_id);
  const auto found = targetFromClicks(cube.image, cube.target, clicks);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, testing::HasSubstr("do not fit"));
}

TEST(FromClicks, RefusesTooFewUnknownAndRepeatedCorners) {
  const ClickedCube cube;
  auto clicks = cube.clicks(0.0, 1);
  EXPECT_FALSE(targetFromClicks(cube.image, cube.target, std::span(clicks).first(5)));
  clicks[1].corner_id = clicks[0].corner_id;
  EXPECT_FALSE(targetFromClicks(cube.image, cube.target, clicks));
  clicks[1].corner_id = 100000;
  EXPECT_FALSE(targetFromClicks(cube.image, cube.target, clicks));
}

TEST(FromClicks, RefusesOneFaceUnlessTheCameraIsKnown) {
  const ClickedCube cube;
  std::vector<CornerClick> clicks;
  for (const std::size_t place : {0, 4, 12, 20, 24, 2}) {
    const int id = cube.target.faces[0][place];
    const auto at = std::find_if(cube.target.corners.begin(), cube.target.corners.end(),
                                 [&](const auto& corner) { return corner.id == id; });
    clicks.push_back({id, *cube.camera.project(cube.cam_from_target * at->position_in_target)});
  }
  const auto refused = targetFromClicks(cube.image, cube.target, clicks);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, testing::HasSubstr("one face"));
  ClickOptions options;
  options.camera = cube.camera;
  const auto found = targetFromClicks(cube.image, cube.target, clicks, options);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_GE(found->view.sightings.size(), 70u);
}

}  // namespace
}  // namespace gyre
