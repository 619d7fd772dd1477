// Pictures of checkerboards whose corners are known exactly.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

// How a picture is taken: what a lens and a sensor do to a sharp pattern.
struct CheckerPicture {
  int width_px = 64;
  int height_px = 64;
  double dark = 50.0;      // grey levels
  double bright = 200.0;   // grey levels
  double psf_px = 0.8;     // scale of the Gaussian blur of the lens
  double noise = 0.0;      // standard deviation, grey levels
  std::uint64_t seed = 1;  // of the noise
};

// Whether a place of the picture is bright.
using Pattern = std::function<bool(const Eigen::Vector2d& pixel)>;

// Renders the pattern with 8 x 8 samples a pixel, CV_8U.
cv::Mat renderPattern(const CheckerPicture& picture, const Pattern& is_bright);

// A checkerboard of unit squares, endless, seen by the homography pixel_from_board.
Pattern checkerPattern(const Eigen::Matrix3d& pixel_from_board);

// Only the squares of [0, columns] x [0, rows] on a bright ground, as a printed board has them; the
// square at the origin is dark.
Pattern boardPattern(const Eigen::Matrix3d& pixel_from_board, int columns, int rows);

// One dark quarter: what is on the positive side of both axes.
Pattern quarterPattern(const Eigen::Matrix3d& pixel_from_board);

}  // namespace gyre
