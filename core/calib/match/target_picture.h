// What every search for a target starts from: the picture in grey, blurred for saddles, its noise.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

struct TargetPicture {
  cv::Mat grey;             // CV_8U
  cv::Mat blurred;          // CV_32F, from blurredForSaddles()
  double noise_grey = 0.0;  // standard deviation, grey levels
};

// From a picture of 8 bits with one, three or four channels. Fails for an empty one and others.
Result<TargetPicture> targetPicture(const cv::Mat& image);

}  // namespace gyre
