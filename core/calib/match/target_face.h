// The faces of a target, each as a flat drawing seen from outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/scan/target.h"

namespace gyre {

// Corners in rows and columns; the first is at column 0, row 0.
struct FaceGrid {
  int columns = 0;
  int rows = 0;
  Eigen::Vector2d pitch_mm = Eigen::Vector2d::Zero();
  std::vector<int> corner_of_cell;  // index into the face's corners, row by row; -1 for a gap

  int cornerAt(int column, int row) const;  // -1 outside, too
};

struct TargetFace {
  struct Corner {
    int point = 0;  // index into pointsOf(target)
    Eigen::Vector2d place_mm = Eigen::Vector2d::Zero();
    double clear_mm = 0.0;  // how far around it no other edge is printed
  };
  struct Marker {
    int id = 0;
    int first_point = 0;  // of its four points, in their order
    std::array<Eigen::Vector2d, 4> corners_mm{};
  };

  int index = 0;  // into the target's faces
  // The drawing's axes: place (x, y) is origin + x right + y down, as one sees it from outside.
  Eigen::Vector3d origin_in_target = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_in_target = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down_in_target = -Eigen::Vector3d::UnitY();
  std::vector<Corner> corners;
  std::vector<Marker> markers;
  std::optional<FaceGrid> grid;  // none when the corners are not a lattice

  Eigen::Vector3d outwardInTarget() const;  // unit
  Eigen::Vector2d placeOf(const Eigen::Vector3d& point_in_target) const;
  Eigen::Vector3d pointAt(const Eigen::Vector2d& place_mm) const;  // in the target frame
  bool holds(const Eigen::Vector3d& point_in_target) const;        // it lies in the face's plane
};

// One a face of the target, in its order; a face of fewer than three corners, or of corners on one
// line, has no corners here.
//
// Outside is told by the page axes, else by the way the markers' corners go round. A target that
// has neither is one that people described: its face that lies flattest is seen from above, and the
// others from the side on which it makes the same bend with them, outwards or inwards.
std::vector<TargetFace> facesOf(const Target& target);

}  // namespace gyre
