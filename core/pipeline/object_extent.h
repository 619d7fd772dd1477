// About how large an object is and how far off the axis, from its outlines in a few views.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/scan/calibration.h"
#include "core/scan/frame.h"

namespace gyre {

// One view's outline.
struct SeenOutline {
  double table_angle_rad = 0.0;
  cv::Mat mask;  // 8 bit, of the picture's size, non-zero on the object
};

// Of the body that the outlines leave: a little more than the object. [mm]
struct ObjectExtent {
  double reach_mm = 0.0;     // farthest from the axis
  double height_mm = 0.0;    // above the platter
  double off_axis_mm = 0.0;  // how far its middle stands from the axis
  // Share of it that is out of the picture somewhere in the turn, also where no view was taken.
  double leaving_share = 0.0;
};

// By a coarse lattice, of which those cells stay that all views show and show on the object. What
// some views do not show is not counted. Nothing when no cell stays. The calibration must have a
// cam_from_table. Any thread.
std::optional<ObjectExtent> objectExtent(const Calibration& calibration,
                                         const std::vector<SeenOutline>& outlines);

}  // namespace gyre
