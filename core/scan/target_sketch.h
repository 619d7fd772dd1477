// A drawing of a target as one sees it from above the table, by which corners are asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace gyre {

// Places are in [0, 1], x to the right, y down, at the same scale.
struct TargetSketch {
  struct Area {
    std::vector<Eigen::Vector2d> outline;  // corners of a convex polygon, in turn
    bool dark = false;
  };
  struct Face {
    std::vector<Eigen::Vector2d> outline;  // likewise
    std::vector<Area> print;               // squares and marks, each upon those before
  };
  struct Corner {
    int corner_id = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };
  std::vector<Face> faces;      // those that are seen, the farthest first
  std::vector<Corner> corners;  // of these
  std::vector<int> to_click;    // ids of the corners that show where the target is; six, or none
};

}  // namespace gyre
