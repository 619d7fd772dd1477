// Where exactly the corners of a coded square are, from straight lines along its four sides.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "core/calib/match/marker_detection.h"
#include "core/scan/frame.h"

namespace gyre {

struct RefinedMarker {
  MarkerCorners corners{};
  std::array<double, 4> sigma_px{};  // one standard deviation of either coordinate
};

// Finds the edge between the dark border and the bright paper along each side to a fraction of a
// pixel, lays a line through it that outliers do not pull, and intersects neighbours. All of a side
// counts, not only what is next to a corner, where the blur rounds it off.
//
// sigma_px follows from how far the edge scatters about its lines. rough: to within half a module
// of the code (a side has modules_a_side of them). Returns nothing when the marker is not wholly
// within the picture, smaller than 2 px a module, or a side shows no edge from dark to bright.
std::optional<RefinedMarker> refineMarker(const cv::Mat& grey, const MarkerCorners& rough,
                                          int modules_a_side);

}  // namespace gyre
