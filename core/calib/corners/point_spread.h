// How points lie in space: in all directions, in a plane, on a line.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"
#include "core/scan/known_point.h"

namespace gyre {

struct PointSpread {
  // In their principal frame the points spread most along x and least along z, about the origin.
  Rigid3 principal_from_target;
  Eigen::Vector3d size_mm = Eigen::Vector3d::Zero();  // standard deviations along x, y, z

  bool onOneLine() const;   // or in one place
  bool inOnePlane() const;  // flatter than what can be told from paper on a table
};

// At least one point.
PointSpread spreadOf(std::span<const KnownPoint> points);

}  // namespace gyre
