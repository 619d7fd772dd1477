// Cameras and views of known points, for tests of calibration: the truth is what made them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/known_point.h"

namespace gyre {

// The 75 corners of three faces of a cube that meet in its corner (0, 0, 0), 5 x 5 a face, between
// squares of 20 mm. [mm]
inline std::vector<Eigen::Vector3d> cubeCorners() {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 1; i <= 5; ++i) {
    for (int j = 1; j <= 5; ++j) {
      const double a = 20.0 * i;
      const double b = 20.0 * j;
      corners.insert(corners.end(), {{a, b, 0.0}, {0.0, a, b}, {b, 0.0, a}});
    }
  }
  return corners;
}

// A flat grid in z = 0. [mm]
inline std::vector<Eigen::Vector3d> gridCorners(int columns, int rows, double square_mm) {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      corners.emplace_back(column * square_mm, row * square_mm, 0.0);
    }
  }
  return corners;
}

inline CameraModel fullHdCamera(double k1 = 0.0) {
  CameraModel camera;
  camera.width_px = 1920;
  camera.height_px = 1080;
  camera.fx = camera.fy = 1600.0;
  camera.cx = 959.5;
  camera.cy = 539.5;
  camera.k1 = k1;
  return camera;
}

// Looks at the point from the direction, both in the target frame; the picture's up is the target's
// z as far as can be.
inline Rigid3 lookAt(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     double distance_mm) {
  const Eigen::Vector3d forward = -direction.normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d(0.03, 0.01, 1.0)).normalized();
  Rigid3 cam_from_target;
  cam_from_target.rotation.row(0) = right.transpose();
  cam_from_target.rotation.row(1) = forward.cross(right).transpose();
  cam_from_target.rotation.row(2) = forward.transpose();
  cam_from_target.translation = -cam_from_target.rotation * (point - distance_mm * forward);
  return cam_from_target;
}

// The cube seen from a little beside its diagonal, 500 mm away, all three faces in sight.
inline Rigid3 cubePose() { return lookAt({30.0, 30.0, 30.0}, {-1.0, -0.8, -0.7}, 500.0); }

inline std::vector<KnownPoint> knownPoints(const CameraModel& camera, const Rigid3& cam_from_target,
                                           const std::vector<Eigen::Vector3d>& places,
                                           double noise_px, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<KnownPoint> points;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d in_cam = cam_from_target * place;
    const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
    points.push_back({place, camera.pixelFromNormalized(in_cam.hnormalized()) + noise_px * noise,
                      noise_px > 0.0 ? noise_px : 0.1});
  }
  return points;
}

// Where the camera stands in the target frame. [mm]
inline Eigen::Vector3d cameraCentre(const Rigid3& cam_from_target) {
  return cam_from_target.inverse().translation;
}

inline double angleBetween(const Rigid3& a, const Rigid3& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation * b.rotation.transpose())).angle();
}

}  // namespace gyre
