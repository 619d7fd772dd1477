// Tells what turns from what stands still when there is no picture of the bare table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>

#include "core/scan/frame.h"

namespace gyre {

// Keeps small copies of frames spread over the scan so far; their median is the room, for every
// part of it that the object does not hide most of the time. One thread at a time.
class MovingMask {
 public:
  // 8 bit, of the frame's size, 255 where the picture differs from the median of the frames so far;
  // all 255 while too few are known. Remembers the frame.
  cv::Mat addFrame(const Frame& frame);

 private:
  cv::Mat median() const;

  std::deque<cv::Mat> remembered_bgr_;
  int frames_seen_ = 0;
  int stride_ = 1;  // every stride-th frame is remembered
};

}  // namespace gyre
