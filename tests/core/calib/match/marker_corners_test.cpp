// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/marker_corners.h"

#include <gtest/gtest.h>

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"
#include "tests/support/rendered_target.h"

namespace gyre {
namespace {

struct RingPicture {
  Target ring = standardTarget("ring")->target;
  CameraModel camera = test::plainCamera(960, 720);
  Rigid3 cam_from_target = test::lookAtTarget(260.0, radFromDeg(50.0), 0.1);
  cv::Mat grey;

  explicit RingPicture(double noise) {
    test::TargetScene scene;
    scene.noise = noise;
    cv::cvtColor(test::renderTarget(ring, camera, cam_from_target, scene), grey,
                 cv::COLOR_BGR2GRAY);
  }
  MarkerCorners truth(int marker) const {
    MarkerCorners corners{};
    for (int k = 0; k < 4; ++k) {
      corners[static_cast<std::size_t>(k)] =
          *test::truePixel(ring, camera, cam_from_target, 4 * marker + k);
    }
    return corners;
  }
};

MarkerCorners shifted(MarkerCorners corners, const Eigen::Vector2d& by) {
  for (auto& corner : corners) corner += by;
  return corners;
}

TEST(MarkerCorners, AreFoundFromAStartThatIsAPixelOff) {
  const RingPicture picture(0.0);
  double squares = 0.0;
  for (int marker = 0; marker < 24; ++marker) {
    const MarkerCorners truth = picture.truth(marker);
    const auto refined = refineMarker(picture.grey, shifted(truth, {0.8, -0.7}), 7);
    ASSERT_TRUE(refined.has_value()) << marker;
    for (std::size_t k = 0; k < 4; ++k) {
      squares += 0.5 * (refined->corners[k] - truth[k]).squaredNorm() / 96.0;
    }
  }
  // Without noise, what is left comes from modules of 4 px, which blur into each other.
  EXPECT_LT(std::sqrt(squares), 0.05);
}

TEST(MarkerCorners, ScatterAsPredicted) {
  const RingPicture picture(4.0);
  double in_sigmas = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int marker = 0; marker < 24; ++marker) {
    const MarkerCorners truth = picture.truth(marker);
    const auto refined = refineMarker(picture.grey, shifted(truth, {0.5, 0.5}), 7);
    if (!refined) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const double square = 0.5 * (refined->corners[k] - truth[k]).squaredNorm();
      squares += square;
      in_sigmas += square / (refined->sigma_px[k] * refined->sigma_px[k]);
      count += 1.0;
    }
  }
  EXPECT_GE(count, 90.0);
  EXPECT_LT(std::sqrt(squares / count), 0.10);
  EXPECT_NEAR(std::sqrt(in_sigmas / count), 1.0, 0.4);
}

TEST(MarkerCorners, AreNotFoundWhereThereIsNoMarker) {
  const cv::Mat empty(480, 640, CV_8U, cv::Scalar(128));
  const MarkerCorners square = {Eigen::Vector2d(100, 100), Eigen::Vector2d(150, 100),
                                Eigen::Vector2d(150, 150), Eigen::Vector2d(100, 150)};
  EXPECT_FALSE(refineMarker(empty, square, 7));
}

TEST(MarkerCorners, RefusesMarkersThatAreTooSmallOrCutOff) {
  const RingPicture picture(0.0);
  const MarkerCorners tiny = {Eigen::Vector2d(100, 100), Eigen::Vector2d(110, 100),
                              Eigen::Vector2d(110, 110), Eigen::Vector2d(100, 110)};
  EXPECT_FALSE(refineMarker(picture.grey, tiny, 7));
  const MarkerCorners beyond = shifted(picture.truth(0), {-2000.0, 0.0});
  EXPECT_FALSE(refineMarker(picture.grey, beyond, 7));
}

}  // namespace
}  // namespace gyre
