// What a simulated picture shows around the object: the platter's top and the still background.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/sim/rig.h"
#include "core/sim/sensor.h"
#include "core/sim/solid_texture.h"

namespace gyre {

// The camera's rays and all that the turning does not change are worked out once, for every pixel.
// Immutable: any thread may paint.
class Stage {
 public:
  // calibration: where the camera stands, which a bump changes. push_in_base: how far the table has
  // slid away under it. [mm]
  Stage(const RigSettings& rig, const Calibration& calibration,
        const Eigen::Vector3d& push_in_base = Eigen::Vector3d::Zero());

  // Direction of a pixel's ray in the base frame, unit along the optical axis. The base goes with
  // the table when that slides.
  const Eigen::Vector3f& direction(std::size_t pixel) const { return direction_[pixel]; }
  const Eigen::Vector3d& cameraInBase() const { return camera_in_base_; }

  // How much of a pixel the platter's top covers, [0, 1].
  float platterCoverage(std::size_t pixel) const { return coverage_[pixel]; }

  // Paints the rows of an empty table that stands at the angle.
  // background_brightness: 1 = as it is on average.
  void paintRow(int y, double table_angle_rad, float background_brightness,
                LightImage& light) const;

 private:
  Eigen::Vector3f platterLight(const Eigen::Vector2f& point_in_table) const;

  int width_px_;
  Eigen::Vector3d camera_in_base_;
  std::vector<Eigen::Vector3f> direction_;
  std::vector<float> coverage_;
  std::vector<Eigen::Vector2f> platter_point_in_base_;  // mm, where the pixel's ray meets z = 0
  std::vector<Eigen::Vector3f> background_;             // RGB
  SolidTexture platter_texture_;
  float platter_light_;
};

}  // namespace gyre
