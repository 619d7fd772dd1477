// How wide the edges in a part of a picture are: blur in pixels, whatever is shown.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scan/frame.h"

namespace gyre {

// Standard deviation of the blur of edges in the area (8 bit, non-zero = counts): two fifths of
// them are sharper than this. A plain object in focus gives about 1 px; texture finer than a pixel
// or two looks sharper than its lens is, down to 0. Nothing when the area holds too few edges that
// stand out of the noise. Any thread.
//
// A step edge of blur s that is blurred by r more has gradients weaker by sqrt(1 + r^2 / s^2).
// Zhuo and Sim, "Defocus map estimation from a single image" (2011), eq. 4.
std::optional<double> edgeWidthPx(const cv::Mat& image_bgr, const cv::Mat& area);

}  // namespace gyre
