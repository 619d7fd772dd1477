// Where exactly two edges cross: the saddle of the brightness at an X-corner, to a few hundredths
// of a pixel. For corners found or predicted elsewhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

struct SaddleFit {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0.0;  // predicted standard deviation of either coordinate
  double contrast = 0.0;  // bright minus dark around it, in grey levels
  // Unit directions in the picture of the two edges that cross there, each along one of its two
  // ways: the squares along +-(edge_a + edge_b) are bright, those along +-(edge_a - edge_b) dark.
  // Good to a few degrees.
  Eigen::Vector2d edge_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d edge_b = Eigen::Vector2d::Zero();
};

// The scale of the Gaussian blur that a picture needs before fitSaddle().
inline constexpr double kSaddleBlur_px = 1.0;
// The radii for which a fit is prepared. Choose less than 0.4 of the height of the projected
// square, so that the neighbouring edges stay out; more of the picture averages more noise.
inline constexpr int kLeastSaddleRadius_px = 2;
inline constexpr int kMostSaddleRadius_px = 6;

// The blurred picture, CV_32F, of a CV_8U grey one.
cv::Mat blurredForSaddles(const cv::Mat& grey);

// Fits a quadric to the disc of this radius and takes its stationary point, again about the point
// found until it stays; found from anywhere within half the radius. blurred: from
// blurredForSaddles(). noise_grey: standard deviation of the noise of the picture before the blur,
// from which sigma_px follows.
//
// Returns nothing when the disc leaves the picture, when the brightness has no saddle there, when
// bright and dark do not alternate four times around it, or when the saddle is further than the
// radius from the start. A radius outside of the prepared ones is moved to the nearest.
std::optional<SaddleFit> fitSaddle(const cv::Mat& blurred, const Eigen::Vector2d& start_px,
                                   int radius_px, double noise_grey = 2.0);

// Where a saddle is expected, and how large a disc is free of other edges there.
struct SaddleGuess {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  int radius_px = kMostSaddleRadius_px;
};

// One fit a guess, in the order of the guesses, in a CV_8U grey picture that is blurred once and
// whose noise is measured.
std::vector<std::optional<SaddleFit>> refineSaddles(const cv::Mat& grey,
                                                    std::span<const SaddleGuess> guesses);

}  // namespace gyre
