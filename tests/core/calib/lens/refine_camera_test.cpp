// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/refine_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stop_token>

#include "tests/support/known_views.h"

namespace gyre {
namespace {

CameraModel truth() {
  CameraModel camera = fullHdCamera(-0.12);
  camera.fx = 1604.0;
  camera.cx = 948.0;
  camera.cy = 551.0;
  camera.k2 = 0.05;
  camera.p1 = 4e-4;
  camera.p2 = -3e-4;
  return camera;
}

std::vector<CameraView> boardViews(const CameraModel& camera, double noise_px,
                                   std::uint64_t seed = 1) {
  std::vector<CameraView> views;
  const std::vector<Eigen::Vector3d> directions = {
      {0.6, 0.1, 1.0}, {-0.6, 0.1, 1.0}, {0.1, 0.7, 1.0}, {0.0, -0.6, 1.0},
      {0.5, 0.5, 1.0}, {-0.4, 0.5, 1.0}, {0.05, 0.0, 1.0}};
  for (std::size_t v = 0; v < directions.size(); ++v) {
    Rigid3 pose = lookAt({80.0, 50.0, 0.0}, directions[v], 300.0);
    // The target is not always in the middle.
    pose.translation += Eigen::Vector3d(30.0 * std::cos(1.7 * static_cast<double>(v)),
                                        20.0 * std::sin(2.3 * static_cast<double>(v)), 0.0);
    views.push_back(
        {pose, knownPoints(camera, pose, gridCorners(9, 6, 20.0), noise_px, hashWords({seed, v}))});
  }
  return views;
}

// What a start may be: the focal length 5 % off, no distortion, each pose a little off.
CameraModel roughCamera() {
  CameraModel rough = fullHdCamera();
  rough.fx = rough.fy = 1680.0;
  return rough;
}

std::vector<CameraView> roughPoses(std::vector<CameraView> views) {
  for (CameraView& view : views) {
    view.cam_from_target.translation += Eigen::Vector3d(4.0, -3.0, 10.0);
    view.cam_from_target.rotation *=
        Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  }
  return views;
}

RefineOptions brown() {
  RefineOptions options;
  options.free_tangential = true;
  return options;
}

TEST(RefineCamera, FindsTheExactCameraFromARoughStart) {
  const auto views = boardViews(truth(), 0.0);
  const auto found = refineCamera(roughCamera(), roughPoses(views), brown());
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->camera.fx, 1604.0, 1e-4);
  EXPECT_NEAR(found->camera.fy, 1600.0, 1e-4);
  EXPECT_NEAR(found->camera.cx, 948.0, 1e-4);
  EXPECT_NEAR(found->camera.cy, 551.0, 1e-4);
  EXPECT_NEAR(found->camera.k1, -0.12, 1e-6);
  EXPECT_NEAR(found->camera.p1, 4e-4, 1e-7);
  EXPECT_LT(found->rms_px, 1e-6);
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_LT(angleBetween(found->cam_from_target[v], views[v].cam_from_target), 1e-7);
  }
}

TEST(RefineCamera, MissesByWhatItsCovarianceSays) {
  constexpr int kSeeds = 30;
  Eigen::Vector4d normalized_squares = Eigen::Vector4d::Zero();
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto views = boardViews(truth(), 0.2, seed);
    // A wrong idea of the noise is corrected by the residuals.
    for (CameraView& view : views) {
      for (KnownPoint& point : view.points) point.sigma_px = 1.0;
    }
    const auto found = refineCamera(roughCamera(), roughPoses(views), brown());
    ASSERT_TRUE(found) << found.error().sentence();
    EXPECT_NEAR(found->rms_px, 0.2 * std::sqrt(2.0), 0.03);
    const auto add = [&](int i, double error, CameraParameter parameter) {
      normalized_squares[i] += error * error / found->covariance(parameter, parameter) / kSeeds;
    };
    add(0, found->camera.fx - 1604.0, kFx);
    add(1, found->camera.cy - 551.0, kCy);
    add(2, found->camera.k1 + 0.12, kK1);
    add(3, found->camera.p2 + 3e-4, kP2);
  }
  // Each is chi-square over 30: 1 with a standard deviation of 0.26.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(normalized_squares[i], 1.0, 0.8) << i;
}

TEST(RefineCamera, HoldsWhatIsNotFree) {
  const auto views = boardViews(fullHdCamera(-0.1), 0.1);
  CameraModel start = fullHdCamera();
  start.fx = 1650.0;
  start.fy = 1500.0;
  RefineOptions options;
  options.free_aspect = options.free_principal = options.free_k2 = false;
  const auto found = refineCamera(start, views, options);
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_NEAR(found->camera.fx / found->camera.fy, 1.1, 1e-12);
  EXPECT_DOUBLE_EQ(found->camera.cx, 959.5);
  EXPECT_DOUBLE_EQ(found->camera.k2, 0.0);
  EXPECT_DOUBLE_EQ(found->camera.skew, 0.0);
  EXPECT_DOUBLE_EQ(found->covariance(kCx, kCx), 0.0);
  EXPECT_GT(found->covariance(kFx, kFx), 0.0);
}

// Reached of the method on such a cube: 1.1 px, 1.6 px and 0.29 mm at noise 0.05 px; 6.5 px, 9.8 px
// and 1.8 mm at 0.3 px. One view is weak.
TEST(RefineCamera, ReachesTheKnownAccuracyOnOneViewOfACube) {
  const CameraModel camera = fullHdCamera(-0.08);
  struct Case {
    double noise_px, focal_px, principal_px, centre_mm;
  };
  for (const Case& known : {Case{0.05, 1.1, 1.6, 0.29}, Case{0.3, 6.5, 9.8, 1.8}}) {
    Case found{};
    constexpr int kSeeds = 40;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      RefineOptions options;
      options.free_k2 = false;
      CameraModel start = fullHdCamera();
      start.fx = start.fy = 1560.0;
      const auto fit = refineCamera(
          start,
          {{cubePose(), knownPoints(camera, cubePose(), cubeCorners(), known.noise_px, seed)}},
          options);
      ASSERT_TRUE(fit) << fit.error().sentence();
      found.focal_px += std::abs(fit->camera.fy - camera.fy) / kSeeds;
      found.principal_px +=
          std::hypot(fit->camera.cx - camera.cx, fit->camera.cy - camera.cy) / kSeeds;
      found.centre_mm +=
          (cameraCentre(fit->cam_from_target[0]) - cameraCentre(cubePose())).norm() / kSeeds;
    }
    const std::string at = "_at_" + std::to_string(known.noise_px);
    RecordProperty("focal_px" + at, std::to_string(found.focal_px));
    RecordProperty("principal_px" + at, std::to_string(found.principal_px));
    RecordProperty("centre_mm" + at, std::to_string(found.centre_mm));
    // A mean of 40 folded normals is good to 12 %; cube and pose differ a little.
    EXPECT_LT(found.focal_px, 1.3 * known.focal_px);
    EXPECT_LT(found.principal_px, 1.3 * known.principal_px);
    EXPECT_LT(found.centre_mm, 1.3 * known.centre_mm);
  }
}

TEST(RefineCamera, PullsLessWhereSightingsAreWrong) {
  auto views = boardViews(truth(), 0.1);
  for (CameraView& view : views) view.points[5].pixel.x() += 25.0;
  RefineOptions options = brown();
  options.cauchy_sigma = 3.0;
  const auto robust = refineCamera(roughCamera(), roughPoses(views), options);
  const auto plain = refineCamera(roughCamera(), roughPoses(views), brown());
  ASSERT_TRUE(robust) << robust.error().sentence();
  ASSERT_TRUE(plain) << plain.error().sentence();
  const auto clean = refineCamera(roughCamera(), roughPoses(boardViews(truth(), 0.1)), brown());
  ASSERT_TRUE(clean) << clean.error().sentence();
  const double sigma_px = std::sqrt(clean->covariance(kFx, kFx));
  EXPECT_LT(std::abs(robust->camera.fx - clean->camera.fx), sigma_px);
  EXPECT_LT(10.0 * sigma_px, std::abs(plain->camera.fx - clean->camera.fx));
}

TEST(RefineCamera, SaysWhyItFails) {
  const auto whyNot = [](const std::vector<CameraView>& views, const Task& task = {}) {
    const auto found = refineCamera(fullHdCamera(), views, {}, task);
    return found ? std::string("it did not fail") : found.error().sentence();
  };
  EXPECT_THAT(whyNot({}), testing::HasSubstr("Too few points"));
  auto views = boardViews(truth(), 0.1);
  // One flat view cannot tell the aspect, the focal length, the centre and the pose.
  const std::vector<CameraView> square = {
      {lookAt({80, 50, 0}, {0.001, 0, 1}, 300),
       knownPoints(fullHdCamera(), lookAt({80, 50, 0}, {0.001, 0, 1}, 300), gridCorners(9, 6, 20.0),
                   0.0)}};
  const auto flat = refineCamera(fullHdCamera(), square, {});
  EXPECT_TRUE(!flat || flat->covariance(kFx, kFx) > 1.0 || flat->rms_px < 1e-6);
  auto behind = views;
  behind[0].cam_from_target.translation.z() = -300.0;
  EXPECT_THAT(whyNot(behind), testing::HasSubstr("behind the camera"));
  auto damaged = views;
  damaged[1].points[2].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(whyNot(damaged), testing::HasSubstr("not usable"));
  damaged = views;
  damaged[1].points[2].sigma_px = 0.0;
  EXPECT_THAT(whyNot(damaged), testing::HasSubstr("not usable"));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(refineCamera(fullHdCamera(), views, {}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
