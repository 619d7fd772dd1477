// A perspective camera with Brown distortion: from directions to pixels and back.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

namespace gyre {

// Intrinsics in pixels; the centre of the first pixel is (0, 0). Distortion as OpenCV defines it:
//   x' = x (1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x y + p2 (r2 + 2 x2),  y' likewise,
//   u = fx x' + skew y' + cx,  v = fy y' + cy.
// Immutable after construction in practice: a value, safe to read from any thread.
struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx = 0.0;  // px
  double fy = 0.0;  // px
  double skew = 0.0;
  double cx = 0.0;  // px
  double cy = 0.0;  // px
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  // The pixel of a point in the camera frame, or nothing when it is not in front of the camera or
  // so far aside that the distortion polynomial folds back. The pixel may lie outside the picture.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_cam) const;

  // The pixel of undistorted normalised coordinates (x/z, y/z).
  Eigen::Vector2d pixelFromNormalized(const Eigen::Vector2d& normalized) const;

  // Undistorted normalised coordinates of a pixel, by Newton's method; exact to 1e-9 wherever the
  // distortion is invertible, which it is inside the picture of any usable lens.
  Eigen::Vector2d normalizedFromPixel(const Eigen::Vector2d& pixel) const;

  // d(pixel) / d(normalised coordinates) there.
  Eigen::Matrix2d pixelJacobian(const Eigen::Vector2d& normalized) const;

  // Unit direction, in the camera frame, in which the pixel looks.
  Eigen::Vector3d rayInCam(const Eigen::Vector2d& pixel) const;

  bool operator==(const CameraModel&) const = default;

  bool contains(const Eigen::Vector2d& pixel, double margin_px = 0.0) const;
};

}  // namespace gyre
