// Finds the corners of single dark or bright shapes: two edges that end in each other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

struct LCornerOptions {
  // Least difference of inside and outside as a sharp right angle shows it. Lower it for pale
  // pictures. [grey levels], 1 .. 255
  double min_contrast = 30.0;

  Result<void> validate() const;
};

struct LCorner {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d inward = Eigen::Vector2d::Zero();  // unit, along the bisector into the shape
  double strength = 0.0;  // the contrast of a sharp right angle of the same response, grey levels
};

// The corners in a CV_8U grey picture by descending strength; equals in the order of the rows.
//
// DET is largest inside the corner, further in at larger scales: its maxima at two scales give the
// bisector, which is walked outwards until the Laplacian changes its sign, where the corner is.
// Five to eight times less exact than X-corners, and corners nearer to each other than 12 px
// disturb each other: prefer checkerboards. An empty picture or one without corners gives none.
// Options out of range are a bug. Deriche and Giraudon, "A Computational Approach for Corner and
// Vertex Detection" (1993).
std::vector<LCorner> detectLCorners(const cv::Mat& grey, const LCornerOptions& options = {});

}  // namespace gyre
