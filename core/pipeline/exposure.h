// How much of a picture holds no detail because it is white or black.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/scan/frame.h"

namespace gyre {

// Shares of all pixels looked at, in [0, 1].
struct Exposure {
  double too_bright = 0.0;  // the brightest channel is at its limit
  double too_dark = 0.0;    // all channels are near zero
};

// Of the whole picture, or of an area of it (8 bit, non-zero = counts; an empty one has no share
// lost). Any thread.
Exposure exposureOf(const cv::Mat& image_bgr);
Exposure exposureOf(const cv::Mat& image_bgr, const cv::Mat& area);

// What to change, one sentence; empty when a twentieth of the picture at most is lost.
std::string exposureAdvice(const Exposure& exposure);

}  // namespace gyre
