// Where the user looks at the scene from: an orbit about a point, z always up.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scene_camera.h"

#include <algorithm>
#include <cmath>

#include <vtkCamera.h>
#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gyre {
namespace {
constexpr double kViewAngle_rad = radFromDeg(30.0);
constexpr double kSteepest_rad = radFromDeg(89.0);  // straight up, left and right lose their sense
}  // namespace

Eigen::Vector3d SceneCamera::towardsEye() const {
  const double flat = std::cos(elevation_rad_);
  return {flat * std::cos(azimuth_rad_), flat * std::sin(azimuth_rad_), std::sin(elevation_rad_)};
}

Eigen::Vector3d SceneCamera::rightward() const {
  return {-std::sin(azimuth_rad_), std::cos(azimuth_rad_), 0.0};
}

void SceneCamera::lookFrom(ViewSide side) {
  elevation_rad_ = 0.0;
  switch (side) {
    case ViewSide::kFront:
      azimuth_rad_ = 0.0;
      break;  // the scanning camera's side at angle 0
    case ViewSide::kBack:
      azimuth_rad_ = kPi;
      break;
    case ViewSide::kLeft:
      azimuth_rad_ = -kPi / 2.0;
      break;
    case ViewSide::kRight:
      azimuth_rad_ = kPi / 2.0;
      break;
    case ViewSide::kTop:
      azimuth_rad_ = 0.0;
      elevation_rad_ = kSteepest_rad;
      break;
    case ViewSide::kIso:
      azimuth_rad_ = -0.9;
      elevation_rad_ = 0.45;
      break;
  }
}

void SceneCamera::fit(const Bounds& bounds) {
  if (bounds.empty()) return;
  focus_ = 0.5 * (bounds.min + bounds.max);
  const double radius = std::max(0.5 * bounds.diagonal(), 1.0);
  distance_mm_ = radius / std::sin(0.5 * kViewAngle_rad);
}

void SceneCamera::rotate(double right, double down) {
  azimuth_rad_ = std::remainder(azimuth_rad_ - right * kPi, kTurn_rad);
  elevation_rad_ = std::clamp(elevation_rad_ + down * kPi, -kSteepest_rad, kSteepest_rad);
}

void SceneCamera::pan(double right, double down) {
  const Eigen::Vector3d up = towardsEye().cross(rightward());
  focus_ += viewHeightMm() * (down * up - right * rightward());
}

void SceneCamera::zoom(double factor) {
  distance_mm_ = std::clamp(distance_mm_ / factor, 1.0, 20000.0);
}

double SceneCamera::viewHeightMm() const {
  return 2.0 * distance_mm_ * std::tan(0.5 * kViewAngle_rad);
}

Eigen::Vector2d SceneCamera::seenAt(const Eigen::Vector3d& position) const {
  constexpr double kNearest_mm = 1e-3;
  const Eigen::Vector3d from_focus = position - focus_;
  const Eigen::Vector3d up = towardsEye().cross(rightward());
  const double depth_mm = std::max(distance_mm_ - from_focus.dot(towardsEye()), kNearest_mm);
  const double height_mm = 2.0 * depth_mm * std::tan(0.5 * kViewAngle_rad);
  return {from_focus.dot(rightward()) / height_mm, -from_focus.dot(up) / height_mm};
}

void SceneCamera::applyTo(vtkCamera& camera) const {
  const Eigen::Vector3d eye = focus_ + distance_mm_ * towardsEye();
  camera.SetViewAngle(degFromRad(kViewAngle_rad));
  camera.SetFocalPoint(focus_.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(0.0, 0.0, 1.0);
}

}  // namespace gyre
