// How bright and dark alternate on a circle around a corner.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

// What a ring of samples showed: two bright and two dark stretches, each pair face to face.
struct CornerRing {
  double contrast = 0.0;  // brightest minus darkest sample, in grey levels
  Eigen::Vector2d edge_a = Eigen::Vector2d::Zero();  // unit; bright along edge_a + edge_b,
  Eigen::Vector2d edge_b = Eigen::Vector2d::Zero();  // dark along edge_a - edge_b
};

// Samples the blurred picture (CV_32F) at 16 places on a circle. Returns nothing when the circle
// leaves the picture, when the samples do not cross their middle exactly four times, when a stretch
// is faint beside the others, or when the edges do not pass straight through the centre.
std::optional<CornerRing> cornerRing(const cv::Mat& blurred, const Eigen::Vector2d& centre_px,
                                     double radius_px);

// The picture (CV_32F) between its pixels, bilinear. The four pixels around must lie in it.
double brightnessAt(const cv::Mat& blurred, const Eigen::Vector2d& pixel);

}  // namespace gyre
