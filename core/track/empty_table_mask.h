// Tells the object from the table by a picture of the bare table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "core/scan/calibration.h"
#include "core/scan/frame.h"

namespace gyre {

// The room stands still, the platter turns, and nobody tells where one ends: a pixel belongs to the
// object only when it looks neither like the bare table's picture there nor like the bare table's
// picture turned, in the platter's plane, to the view's angle. Immutable; any thread.
class EmptyTableMask {
 public:
  // empty_table: the bare table at its frame's angle. The calibration must have a cam_from_table.
  EmptyTableMask(const Calibration& calibration, const FramePtr& empty_table);

  // 8 bit, of the frame's size, 255 on the object.
  cv::Mat maskOf(const Frame& frame) const;

 private:
  cv::Mat turnedTable(double table_angle_rad) const;

  Calibration calibration_;
  double scale_ = 1.0;  // working picture over full picture
  double empty_angle_rad_ = 0.0;
  double threshold_ = 0.0;               // grey levels
  cv::Mat empty_bgr_;                    // working size
  std::array<cv::Mat, 3> empty_padded_;  // the same by channels, a pixel wider all around
  // CV_32FC2: where the rays of some working pixels meet z = 0, mm; NaN where they do not.
  cv::Mat platter_in_base_;
};

}  // namespace gyre
