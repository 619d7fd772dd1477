// Finds the points of a picture in which four squares meet, dark and bright by turns.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

struct XCornerOptions {
  // Least difference of bright and dark as a sharp corner shows it. Lower it for pale prints and
  // dark pictures, raise it when texture is taken for corners. [grey levels], 1 .. 255
  double min_contrast = 12.0;
  // The same as a share of the strongest corner in the picture. [0, 1)
  double min_relative_contrast = 0.1;
  // No more than this many, the strongest. [1, 1000000]
  int max_corners = 20000;

  Result<void> validate() const;
};

struct XCorner {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double strength = 0.0;  // the contrast that a sharp corner of the same response has, grey levels
  double sigma_px = 0.0;  // predicted standard deviation of either coordinate
  // Unit directions in the picture of the two edges that cross there, each along one of its two
  // ways: the squares along +-(edge_a + edge_b) are bright, those along +-(edge_a - edge_b) dark.
  Eigen::Vector2d edge_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d edge_b = Eigen::Vector2d::Zero();
  // How far around it bright and dark alternate four times and no more: no more than the height of
  // the smallest of its four squares. From 3 up to 15 px, where the search ends.
  double clear_radius_px = 0.0;
};

// The corners in a CV_8U grey picture by descending strength; equals in the order of the rows.
//
// Beaudet's DET at two scales, non-maximum suppression, a ring of samples that must change between
// bright and dark exactly four times, and a saddle fit whose disc is as large as the squares allow.
// Squares must be at least 4 px high in the picture. An empty picture or one without corners gives
// none. Options out of range are a bug. Beaudet, "Rotationally invariant image operators" (1978).
std::vector<XCorner> detectXCorners(const cv::Mat& grey, const XCornerOptions& options = {});

}  // namespace gyre
