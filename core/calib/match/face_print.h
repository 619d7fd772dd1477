// What is printed on a face without markers, as areas to be drawn.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/calib/match/target_face.h"
#include "core/scan/target.h"

namespace gyre {

struct PrintedArea {
  std::vector<Eigen::Vector3d> outline_in_target;  // mm; a convex polygon in the face's plane
  bool dark = true;
};

// The face's dark squares, then its round marks, which lie upon them. Nothing for a face with
// markers or without rows and columns.
std::vector<PrintedArea> printOf(const Target& target, const TargetFace& face);

}  // namespace gyre
