// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr int kAll = kCameraSize + kAxisSize + 1 + kTargetSize + kFaceSize + 1;
using All = Eigen::Matrix<double, kAll, 1>;

RigParameters parametersFrom(const All& all) {
  RigParameters at;
  at.camera = all.segment<kCameraSize>(0);
  at.axis = all.segment<kAxisSize>(9);
  at.angle_rad = all[13];
  at.target = all.segment<kTargetSize>(14);
  at.face = all.segment<kFaceSize>(20);
  at.page_stretch = all[29];
  return at;
}

TEST(RigProjection, HasTheDerivativesOfItsOwnDifferences) {
  CameraModel camera;
  camera.fx = 1500.0;
  camera.fy = 1510.0;
  camera.skew = 2.0;
  RigFrames frames;
  frames.camera = camera;
  frames.cam_from_base = {
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 0.2, 0.1).normalized()).toRotationMatrix(),
      {10.0, 20.0, 350.0}};
  frames.table_from_target = {
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(0, 0.2, 1).normalized()).toRotationMatrix(),
      {3.0, 5.0, 1.0}};
  FacePoint point;
  point.position_in_target = {30.0, -12.0, 25.0};
  point.from_middle = {20.0, -12.0, 0.0};
  point.stretch = {10.0, 6.0, 0.0};
  point.normal = Eigen::Vector3d(0.1, 0.2, 0.9).normalized();
  point.bow = {0.3, -0.4, 0.2};
  All at;
  at << 1500.0, 1.007, 640.0, 480.0, -0.1, 0.05, -0.02, 1e-3, -2e-3,  //
      0.01, -0.02, 0.5, -0.3, 0.7,                                    //
      0.02, 0.03, -0.01, 0.4, -0.2, 0.1,                              //
      0.05, -0.1, 0.2, 0.3, 0.1, -0.2, 0.5, -0.4, 0.3, 0.01;
  Eigen::Vector2d pixel;
  RigJacobian by;
  ASSERT_TRUE(projectRig(frames, parametersFrom(at), point, &pixel, &by));
  Eigen::Matrix<double, 2, kAll> analytic;
  analytic << by.camera, by.axis, by.angle, by.target, by.face, by.page_stretch;
  for (int i = 0; i < kAll; ++i) {
    const double step = 1e-6 * std::max(1.0, std::abs(at[i]));
    All more = at;
    All less = at;
    more[i] += step;
    less[i] -= step;
    Eigen::Vector2d up;
    Eigen::Vector2d down;
    ASSERT_TRUE(projectRig(frames, parametersFrom(more), point, &up, nullptr));
    ASSERT_TRUE(projectRig(frames, parametersFrom(less), point, &down, nullptr));
    const Eigen::Vector2d numeric = (up - down) / (2.0 * step);
    // Central differences are good to about 1e-6 of the value.
    EXPECT_LT((analytic.col(i) - numeric).norm(), 1e-5 * (1.0 + numeric.norm())) << i;
  }
}

TEST(RigProjection, HasNoPixelBehindTheCamera) {
  RigFrames frames;
  frames.camera.fx = frames.camera.fy = 1000.0;
  RigParameters at;
  at.camera = cameraVector(frames.camera);
  FacePoint point;
  point.position_in_target = {0.0, 0.0, -10.0};
  Eigen::Vector2d pixel;
  EXPECT_FALSE(projectRig(frames, at, point, &pixel, nullptr));
}

TEST(FacesOf, LookOutwards) {
  Target target;
  target.corners = {{0, {0, 0, 10}}, {1, {10, 0, 10}}, {2, {0, 10, 10}},
                    {3, {0, 0, 0}},  {4, {10, 0, 0}},  {5, {0, 10, 0}}};
  target.faces = {{0, 2, 1}, {3, 4, 5}};
  const std::vector<TargetPiece> faces = facePiecesOf(target);
  EXPECT_NEAR(faces[0].normal.z(), 1.0, 1e-12);
  EXPECT_NEAR(faces[1].normal.z(), -1.0, 1e-12);
}

}  // namespace
}  // namespace gyre
