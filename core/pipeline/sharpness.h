// How sharp a picture is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/frame.h"

namespace gyre {

// Variance of the picture's Laplacian, in squared grey levels: it grows with sharpness, and only
// pictures of the same scene may be compared by it. Any thread.
// Pech-Pacheco et al., "Diatom autofocusing in brightfield microscopy" (2000).
double sharpnessOf(const cv::Mat& image_bgr);

}  // namespace gyre
