// A picture in grey at several sizes, made once a frame and shared by all that look at it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/frame.h"

namespace gyre {

struct GreyPyramid {
  cv::Mat grey;                 // 8 bit, 1 channel, full size
  std::vector<cv::Mat> levels;  // as pyramidal LK wants it: pictures and their derivatives
  double noise_sigma = 1.0;     // standard deviation of the picture's noise, grey levels
};

// window_px: the window LK will use on it. Thread: any.
GreyPyramid buildGreyPyramid(const cv::Mat& image_bgr, int window_px);

// Standard deviation of a picture's white noise in grey levels, read off its calmest blocks.
// Immerkaer, "Fast noise variance estimation" (1996), block-wise so that texture does not count.
double estimateNoiseSigma(const cv::Mat& grey);

}  // namespace gyre
