// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/camera_model.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

CameraModel distortedCamera() {
  CameraModel camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = 1500;
  camera.fy = 1480;
  camera.skew = 2.0;
  camera.cx = 650;
  camera.cy = 470;
  camera.k1 = -0.21;
  camera.k2 = 0.07;
  camera.p1 = 0.001;
  camera.p2 = -0.0007;
  camera.k3 = -0.01;
  return camera;
}

TEST(CameraModel, ProjectsThePointOnTheAxisToThePrincipalPoint) {
  const auto pixel = distortedCamera().project({0, 0, 300});
  ASSERT_TRUE(pixel);
  EXPECT_EQ(*pixel, Eigen::Vector2d(650, 470));
}

TEST(CameraModel, AgreesWithTheDistortionFormulaWorkedByHand) {
  CameraModel camera;
  camera.fx = camera.fy = 1000;
  camera.k1 = 0.1;
  camera.p1 = 0.01;
  // x = 0.2, y = 0.1: r2 = 0.05, radial 1.005; x' = 0.201 + 2*0.01*0.02 = 0.2014,
  // y' = 0.1005 + 0.01*(0.05 + 0.02) = 0.1012.
  const Eigen::Vector2d pixel = camera.pixelFromNormalized({0.2, 0.1});
  EXPECT_NEAR(pixel.x(), 201.4, 1e-9);
  EXPECT_NEAR(pixel.y(), 101.2, 1e-9);
}

TEST(CameraModel, UndistortionInvertsDistortionOverTheWholePicture) {
  const CameraModel camera = distortedCamera();
  for (int v = 0; v < 960; v += 95) {
    for (int u = 0; u < 1280; u += 127) {
      const Eigen::Vector2d pixel(u, v);
      const Eigen::Vector2d back = camera.pixelFromNormalized(camera.normalizedFromPixel(pixel));
      EXPECT_LT((back - pixel).norm(), 1e-7);
    }
  }
}

TEST(CameraModel, JacobianIsTheSlopeOfTheProjection) {
  const CameraModel camera = distortedCamera();
  const Eigen::Vector2d at(0.21, -0.13);
  const Eigen::Matrix2d jacobian = camera.pixelJacobian(at);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d slope =
        (camera.pixelFromNormalized(at + step) - camera.pixelFromNormalized(at - step)) /
        (2 * kStep);
    EXPECT_LT((slope - jacobian.col(i)).norm(), 1e-4);
  }
}

TEST(CameraModel, GivesNothingForPointsBehindTheCamera) {
  EXPECT_FALSE(distortedCamera().project({0, 0, -1}));
  EXPECT_FALSE(distortedCamera().project({0, 0, 0}));
}

TEST(CameraModel, DoesNotFoldPointsFarAsideIntoThePicture) {
  CameraModel camera;
  camera.fx = camera.fy = 1000;
  camera.k1 = -0.08;
  // At x = 3.5 the polynomial gives 3.5 (1 - 0.98) = 0.07: nearly the middle of the picture.
  EXPECT_FALSE(camera.project({350, 0, 100}));
  EXPECT_TRUE(camera.project({50, 0, 100}));
}

}  // namespace
}  // namespace gyre
