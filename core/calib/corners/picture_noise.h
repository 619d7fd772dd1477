// How noisy a picture is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/frame.h"

namespace gyre {

// Standard deviation of the noise of a CV_8U grey picture, in grey levels, taken for white and the
// same everywhere; at least that of rounding to whole levels. From what a mask blind to planes and
// edges leaves: the median, so that structure on less than half of the picture does not count.
// Immerkaer, "Fast Noise Variance Estimation" (1996), with a median in place of the mean.
double pictureNoise(const cv::Mat& grey);

}  // namespace gyre
