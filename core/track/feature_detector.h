// Finds places that can be followed, spread evenly over the object.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"
#include "core/track/options.h"

namespace gyre {

struct Feature {
  Eigen::Vector2d pixel;
  double sigma_px = 0.0;  // how well the texture around it locates it, in its worst direction
};

// The best feature of each empty cell of a square grid, where "best" is the smallest standard
// deviation that the structure tensor promises at the picture's noise: sigma^2 = 2 sigma_I^2 /
// lambda_min. Cells that hold one of the occupied pixels give none, nor do places outside allowed
// (8 bit, non-zero = yes). Shi and Tomasi, "Good features to track" (1994).
std::vector<Feature> detectFeatures(const cv::Mat& grey, double noise_sigma, const cv::Mat& allowed,
                                    std::span<const Eigen::Vector2d> occupied,
                                    const TrackOptions& options);

}  // namespace gyre
