// The outline of the object in one view.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan/frame.h"

namespace gyre {

// What is 0 shows background for certain; the outline is a little wider than the object.
struct Silhouette {
  std::uint32_t view = 0;  // index of the view, as points name it
  cv::Mat mask;            // 8 bit, 255 on the object; smaller than the picture by a whole factor
};
using Silhouettes = std::vector<Silhouette>;  // ascending by view; views without one are left out

}  // namespace gyre
