// The same spots of an object in two pictures that may lie far apart.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

// Spots of one picture that can be told again.
struct ViewSpots {
  std::vector<Eigen::Vector2d> pixels;
  cv::Mat descriptors;  // a row a spot
};

struct PixelMatch {
  Eigen::Vector2d first;
  Eigen::Vector2d second;
};

// object_mask: 8 bit, non-zero where to look; empty = everywhere. Slow: a second for a megapixel.
// Lowe, "Distinctive image features from scale-invariant keypoints" (2004). Thread: any.
ViewSpots findSpots(const cv::Mat& grey, const cv::Mat& object_mask = {});

// Spots that are each other's nearest and clearly nearer than the next, and that are not where
// they were: what stands still behind a turning table says nothing of its turning.
std::vector<PixelMatch> matchSpots(const ViewSpots& first, const ViewSpots& second);

}  // namespace gyre
