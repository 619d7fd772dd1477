// A picture in grey at several sizes, made once a frame and shared by all that look at it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/frame.h"

namespace gyre {

struct GreyPyramid {
  cv::Mat grey;                 // 8 bit, 1 channel, full size
  std::vector<cv::Mat> levels;  // as pyramidal LK wants it: pictures and their derivatives
};

cv::Mat greyOf(const cv::Mat& image_bgr);  // 8 bit, 1 channel

// window_px: the window LK will use on it. Thread: any.
GreyPyramid buildGreyPyramid(const cv::Mat& image_bgr, int window_px);

// Standard deviation of a picture's white noise in grey levels, read off the calmest blocks of the
// area (8 bit, non-zero = counts; empty = the whole picture): a black background is not noisy, so
// noise is measured where features are.
// Immerkaer, "Fast noise variance estimation" (1996), block-wise so that texture does not count.
double estimateNoiseSigma(const cv::Mat& grey, const cv::Mat& area = {});

}  // namespace gyre
