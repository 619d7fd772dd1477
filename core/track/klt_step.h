// Follows features from one picture to the next and back again.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/track/grey_pyramid.h"

namespace gyre {

struct KltMove {
  Eigen::Vector2f from;       // pixel in the first picture
  Eigen::Vector2f predicted;  // where to begin in the second
};

struct KltOutcome {
  Eigen::Vector2f to = Eigen::Vector2f::Zero();
  float round_trip_px = 0.0F;  // how far tracking back misses the start
  bool found = false;
};

// One outcome a move. Pyramidal Lucas-Kanade on ready pyramids, from the prediction, there and
// back. Bouguet, "Pyramidal implementation of the Lucas Kanade feature tracker" (2000).
std::vector<KltOutcome> kltStep(const GreyPyramid& first, const GreyPyramid& second,
                                std::span<const KltMove> moves, int window_px);

}  // namespace gyre
