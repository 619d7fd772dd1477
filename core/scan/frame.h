// One picture of the camera, with what was known of the table when it was taken.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include <opencv2/core/mat.hpp>

namespace gyre {

// Immutable once published: handed on as FramePtr, across threads too.
struct Frame {
  int view = -1;                 // index of the view in its scan, from 0; -1 outside a scan
  std::string name;              // file name without folder; empty when it was never a file
  double table_angle_rad = 0.0;  // as commanded or read from angles.csv
  double time_s = 0.0;           // arrival on the clock of steadySeconds(); 0 when from a file
  cv::Mat image_bgr;             // 8 bit, 3 channels, raw (distorted), never empty
};

using FramePtr = std::shared_ptr<const Frame>;

}  // namespace gyre
