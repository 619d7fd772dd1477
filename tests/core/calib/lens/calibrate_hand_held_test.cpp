// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/calibrate_hand_held.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include "tests/support/known_views.h"

namespace gyre {
namespace {

Target board() {
  Target target;
  target.faces.emplace_back();
  for (const Eigen::Vector3d& place : gridCorners(9, 6, 20.0)) {
    const int id = static_cast<int>(target.corners.size());
    target.corners.push_back({id, place});
    target.faces[0].push_back(id);
  }
  return target;
}

Target cube() {
  Target target;
  target.faces.resize(3);
  for (const Eigen::Vector3d& place : cubeCorners()) {
    const int id = static_cast<int>(target.corners.size());
    target.corners.push_back({id, place});
    target.faces[static_cast<std::size_t>(id) % 3].push_back(id);
  }
  return target;
}

CameraModel wideCamera() {
  CameraModel camera = fullHdCamera(-0.25);
  camera.fx = 1101.0;
  camera.fy = 1100.0;
  camera.cx = 970.0;
  camera.k2 = 0.09;
  return camera;
}

TargetView viewOf(const Target& target, const CameraModel& camera, const Rigid3& cam_from_target,
                  double noise_px, std::uint64_t seed) {
  std::vector<Eigen::Vector3d> places;
  for (const TargetCorner& corner : target.corners) places.push_back(corner.position_in_target);
  TargetView view;
  view.name = "view";
  int index = 0;
  for (const KnownPoint& point : knownPoints(camera, cam_from_target, places, noise_px, seed)) {
    view.sightings.push_back({index++, point.pixel, 0.05});
  }
  return view;
}

std::vector<Rigid3> boardPoses() {
  std::vector<Rigid3> poses;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0.6, 0.1, 1.0), Eigen::Vector3d(-0.6, 0.1, 1.0),
        Eigen::Vector3d(0.1, 0.7, 1.0), Eigen::Vector3d(0.0, -0.6, 1.0),
        Eigen::Vector3d(0.5, 0.5, 1.0), Eigen::Vector3d(-0.4, 0.5, 1.0),
        Eigen::Vector3d(0.05, 0.0, 1.0)}) {
    Rigid3 pose = lookAt({80.0, 50.0, 0.0}, direction, 220.0);
    pose.translation.x() += 40.0 * std::cos(2.0 * static_cast<double>(poses.size()));
    pose.translation.y() += 25.0 * std::sin(3.0 * static_cast<double>(poses.size()));
    poses.push_back(pose);
  }
  return poses;
}

std::vector<TargetView> boardViews(double noise_px) {
  std::vector<TargetView> views;
  for (const Rigid3& pose : boardPoses()) {
    views.push_back(viewOf(board(), wideCamera(), pose, noise_px, views.size() + 1));
  }
  return views;
}

const Eigen::Vector2i kSize_px(1920, 1080);

TEST(CalibrateHandHeld, FindsTheCameraFromABoard) {
  const auto found = calibrateHandHeld(board(), boardViews(0.1), kSize_px);
  ASSERT_TRUE(found) << found.error().sentence();
  const CameraModel& camera = found->calibration.camera;
  EXPECT_FALSE(found->calibration.cam_from_table);
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_NEAR(camera.fx, 1101.0, 4.0 * found->report.focal_sigma_px);
  EXPECT_NEAR(camera.cx, 970.0, 4.0 * found->report.principal_sigma_px);
  EXPECT_NEAR(camera.k1, -0.25, 0.01);
  EXPECT_LT(found->report.focal_sigma_px, 4.0);
  // Two coordinates of 0.1 px each.
  EXPECT_NEAR(found->report.rms_px, 0.1 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(found->report.views, 7U);
  EXPECT_EQ(found->report.sightings + found->report.outliers, 7U * 54U);
  EXPECT_LE(found->report.outliers, 2U);
  for (std::size_t v = 0; v < boardPoses().size(); ++v) {
    ASSERT_TRUE(found->cam_from_target[v]);
    EXPECT_LT(angleBetween(*found->cam_from_target[v], boardPoses()[v]), 2e-3);
  }
}

TEST(CalibrateHandHeld, FindsTheCameraFromACube) {
  std::vector<TargetView> views;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(-1, -0.6, -0.5),
        Eigen::Vector3d(-0.5, -1, -1)}) {
    views.push_back(viewOf(cube(), wideCamera(), lookAt({40, 40, 40}, direction, 300.0), 0.1,
                           views.size() + 1));
  }
  const auto found = calibrateHandHeld(cube(), views, kSize_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->calibration.camera.fx, 1101.0, 4.0 * found->report.focal_sigma_px);
}

TEST(CalibrateHandHeld, LeavesOutWhatDoesNotFit) {
  auto views = boardViews(0.1);
  for (std::size_t v = 0; v < views.size(); ++v) views[v].sightings[3 * v].pixel.y() += 9.0;
  const auto found = calibrateHandHeld(board(), views, kSize_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_GE(found->report.outliers, 7U);
  EXPECT_LE(found->report.outliers, 9U);
  EXPECT_FALSE(found->report.residuals[0].used);
  EXPECT_NEAR(found->calibration.camera.fx, 1101.0, 4.0 * found->report.focal_sigma_px);
}

TEST(CalibrateHandHeld, PassesOverViewsThatShowTooLittle) {
  auto views = boardViews(0.05);
  views[2].sightings.resize(5);
  views.push_back({});
  const auto found = calibrateHandHeld(board(), views, kSize_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->report.views, 6U);
  EXPECT_FALSE(found->cam_from_target[2]);
  EXPECT_FALSE(found->cam_from_target[7]);
  ASSERT_EQ(found->report.remarks.size(), 1U);
  EXPECT_THAT(found->report.remarks[0], testing::StartsWith("2 pictures were left out"));
}

TEST(CalibrateHandHeld, PassesOverAViewThatWasMatchedWrongly) {
  auto views = boardViews(0.1);
  // Scrambled: no place of the board looks like that.
  for (PointSighting& sighting : views[3].sightings) {
    sighting.point = sighting.point * 7 % 54;
  }
  const auto found = calibrateHandHeld(board(), views, kSize_px);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->report.views, 6U);
  EXPECT_FALSE(found->cam_from_target[3]);
  EXPECT_NEAR(found->calibration.camera.fx, 1101.0, 4.0 * found->report.focal_sigma_px);
}

TEST(CalibrateHandHeld, SaysWhyItFails) {
  const auto whyNot = [](const std::vector<TargetView>& views) {
    const auto found = calibrateHandHeld(board(), views, kSize_px);
    return found ? std::string("it did not fail") : found.error().sentence();
  };
  EXPECT_THAT(whyNot({}), testing::HasSubstr("No picture shows enough"));
  // All alike and square to the camera: any focal length fits.
  std::vector<TargetView> alike;
  for (std::uint64_t v = 1; v <= 6; ++v) {
    const Rigid3 pose =
        lookAt({80.0, 50.0, 0.0}, {0.002, 0.001, 1.0}, 200.0 + 10.0 * static_cast<double>(v));
    alike.push_back(viewOf(board(), wideCamera(), pose, 0.1, v));
  }
  EXPECT_THAT(whyNot(alike), testing::AnyOf(testing::HasSubstr("focal length open"),
                                            testing::HasSubstr("do not determine")));
  EXPECT_THAT(whyNot({boardViews(0.1)[0]}), testing::AnyOf(testing::HasSubstr("focal length open"),
                                                           testing::HasSubstr("do not determine")));
  auto foreign = boardViews(0.1);
  foreign[0].sightings[0].point = 54;
  EXPECT_THAT(whyNot(foreign), testing::HasSubstr("do not belong"));
  auto damaged = boardViews(0.1);
  damaged[0].sightings[0].pixel.x() = std::nan("");
  EXPECT_THAT(whyNot(damaged), testing::HasSubstr("do not belong"));
  EXPECT_FALSE(calibrateHandHeld(board(), boardViews(0.1), {0, 0}));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(calibrateHandHeld(board(), boardViews(0.1), kSize_px, {}, Task(stop.get_token()))
                .error()
                .code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
