// The outline of the object in one view.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/scan/frame.h"

namespace gyre {

// Smaller than the picture by a whole factor; a pixel is 255 where any of the picture's pixels in
// it shows the object, so that 0 is background, as far as the picture could tell.
struct Silhouette {
  std::uint32_t view = 0;  // index of the view, as points name it
  cv::Mat mask;            // 8 bit, 255 on the object, else 0
};

// How many of the picture's pixels lie along a side of one of the mask's.
inline double shrinkOf(const cv::Mat& mask, int picture_width_px) {
  return std::round(static_cast<double>(picture_width_px) / mask.cols);
}

using Silhouettes = std::vector<Silhouette>;  // ascending by view; views without one are left out

}  // namespace gyre
