// Where the user looks at the scene from: an orbit about a point, z always up.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/scan/point_cloud.h"

class vtkCamera;

namespace gyre {

enum class ViewSide { kFront, kBack, kLeft, kRight, kTop, kIso };

// A value. Screen lengths are shares of the view's height, so that it knows no pixels.
class SceneCamera {
 public:
  void lookFrom(ViewSide side);
  void fit(const Bounds& bounds);
  void rotate(double right, double down);  // a share of 1 is half a turn
  void pan(double right, double down);
  void zoom(double factor);  // > 1 comes nearer

  // Millimetres that the view's height shows at the distance of the point looked at.
  double viewHeightMm() const;

  // Where a place is seen: right and down from the view's middle. What lies behind the eye is seen
  // at the edge of infinity.
  Eigen::Vector2d seenAt(const Eigen::Vector3d& position) const;

  void applyTo(vtkCamera& camera) const;

 private:
  Eigen::Vector3d towardsEye() const;
  Eigen::Vector3d rightward() const;

  Eigen::Vector3d focus_ = Eigen::Vector3d(0.0, 0.0, 30.0);  // mm, table frame
  double azimuth_rad_ = -0.9;                                // of the eye, about z from x
  double elevation_rad_ = 0.45;
  double distance_mm_ = 400.0;
};

}  // namespace gyre
