// A calibration target taken apart into the plane sheets of paper that carry its print.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/target.h"
#include "core/sim/sheet_print.h"

namespace gyre {

struct TargetSheet {
  int face = -1;  // index into the target's faces; -1: markers that belong to none
  // The sheet's frame in the target: places are mm right and down from the middle of its points.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down = -Eigen::Vector3d::UnitY();
  bool has_page_axes = false;  // right and down are those of the page
  SheetPrint print{Eigen::Vector2d::Ones()};
  std::vector<std::vector<Eigen::Vector2d>> pieces;  // convex outlines of the paper

  Eigen::Vector3d outward() const { return down.cross(right); }
  Eigen::Vector2d placeOf(const Eigen::Vector3d& point_in_target) const {
    return {right.dot(point_in_target - middle), down.dot(point_in_target - middle)};
  }
  Eigen::Vector3d inTarget(const Eigen::Vector2d& place) const {
    return middle + place.x() * right + place.y() * down;
  }
};

// The target's faces, in their order, as a checkerboard each with a rim of half a square, cut off
// where another face or the table begins; then its other markers, each on a patch one module wider
// than itself. Fails when corners belong to no face, or do not lie on a lattice to 0.05 mm.
Result<std::vector<TargetSheet>> sheetsOf(const Target& target);

}  // namespace gyre
