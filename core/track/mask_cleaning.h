// Makes an object's mask of single changed pixels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/frame.h"

namespace gyre {

// changed: 8 bit, non-zero where the picture differs from the bare table. Returns 255 on the
// object: gaps closed, specks removed, holes filled up to max_hole_share of the largest part's
// area. Parts much smaller than the largest are dropped.
cv::Mat cleanMask(const cv::Mat& changed, double max_hole_share);

}  // namespace gyre
