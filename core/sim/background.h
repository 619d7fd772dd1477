// The world that stands still behind the table: a desk with clutter on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry/ray.h"
#include "core/sim/rig.h"
#include "core/sim/solid_texture.h"

namespace gyre {

// Immutable: any thread may look.
class Background {
 public:
  // push: how far the table has slid in it. [mm]
  explicit Background(const RigSettings& rig,
                      const Eigen::Vector3d& push = Eigen::Vector3d::Zero());

  // The light that comes along a ray in the base frame, RGB in [0, 1]. The platter's side is part
  // of it, its top is not.
  Eigen::Vector3f radiance(const Ray& ray_in_base) const;

 private:
  struct Box {
    Eigen::Vector3d centre;  // base frame, mm
    Eigen::Vector3d half;    // mm
    Eigen::Matrix3d box_from_base;
    Eigen::Vector3f paint;
  };
  struct Hit {
    double distance = 0.0;
    Eigen::Vector3d normal;
    Eigen::Vector3f paint;
  };

  static void meetBox(const Box& box, const Ray& ray, Hit& nearest);
  void meetDesk(const Ray& ray, Hit& nearest) const;
  void meetPlatterSide(const Ray& ray, Hit& nearest) const;

  std::vector<Box> boxes_;
  SolidTexture texture_;
  Eigen::Vector3d light_;
  double ambient_;
  double key_;
  double platter_radius_mm_;
  Eigen::Vector3d platter_in_base_;
};

}  // namespace gyre
