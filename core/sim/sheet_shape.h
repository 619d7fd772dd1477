// How a sheet of a target truly lies in space: misprinted, bent, and folded a little wrong.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid3.h"
#include "core/sim/rig.h"
#include "core/sim/target_sheets.h"

namespace gyre {

// In this order:
// 1. A face is stretched about its middle along the page as the printer did, and moves with the
//    target as a whole, which grows by the mean of both ways.
// 2. It bows about the page's down axis, its middle outward, its left and right rims in place;
//    paper bends without stretching, so the rims come nearer to each other.
// 3. It is turned about its lowest edge by the error of its fold, outward or inward as the seed
//    chooses; a face that lies level, about its lower edge on the page. A lone sheet is not folded.
// Markers that belong to no face are stuck on the platter: they grow with the target, no more.
class SheetShape {
 public:
  SheetShape(const TargetSheet& sheet, const RigSettings& rig, std::size_t sheets);

  // From a place on the sheet as it is meant to be, mm, to the target frame.
  Eigen::Vector3d inTarget(const Eigen::Vector2d& place) const;

 private:
  Eigen::Vector3d bentInTarget(const Eigen::Vector2d& place) const;

  Eigen::Vector3d middle_;
  Eigen::Vector3d right_;
  Eigen::Vector3d down_;
  Eigen::Vector3d outward_;
  Eigen::Vector2d stretch_ = Eigen::Vector2d::Ones();
  double bow_mm_ = 0.0;
  double half_width_mm_ = 1.0;
  Rigid3 folded_from_flat_;
};

// The target as it truly is: all its points where the sheets carry them. What a solver that frees
// the faces should find.
Target trueTarget(const Target& target, const std::vector<TargetSheet>& sheets,
                  const RigSettings& rig);

}  // namespace gyre
