// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/saddle_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/calib/corners/corner_ring.h"
#include "core/calib/corners/picture_noise.h"

namespace gyre {
namespace {

constexpr int kBlurReach_px = 3;  // three scales of the Gaussian
constexpr int kMostSteps = 10;
constexpr double kStays_px = 0.002;
// What remains without noise, from the pixel grid and from neighbours that reach into the disc.
constexpr double kSystematicSigma_px = 0.01;
// Closer to the corner a ring sees the blur more than the squares.
constexpr double kLeastRing_px = 3.0;

// How the coefficients of  I ~ a x^2 + b x y + c y^2 + d x + e y + g  follow from the samples of a
// disc: constant for a disc centred on the estimate, so computed once a radius.
struct DiscFit {
  std::vector<Eigen::Vector2i> offsets;
  Eigen::Matrix<float, 5, Eigen::Dynamic, Eigen::RowMajor> coefficients_from_samples;  // a b c d e
  double slope_noise = 0.0;  // standard deviation of d and of e for noise 1 before the blur
};

// Standard deviation of sum(weight * blurred white noise) over the samples.
double noiseThroughBlur(const std::vector<Eigen::Vector2i>& offsets, const Eigen::VectorXd& weights,
                        int radius_px) {
  const int half = radius_px + 1 + kBlurReach_px;
  const int side = 2 * half + 1;
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(side, side);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const int x = offsets[i].x() + half;
    const int y = offsets[i].y() + half;
    for (int dy = -kBlurReach_px; dy <= kBlurReach_px; ++dy) {
      for (int dx = -kBlurReach_px; dx <= kBlurReach_px; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= side || y + dy >= side) continue;
        const double blur =
            std::exp(-0.5 * (dx * dx + dy * dy) / (kSaddleBlur_px * kSaddleBlur_px)) /
            (kTurn_rad * kSaddleBlur_px * kSaddleBlur_px);
        share(y + dy, x + dx) += weights(static_cast<Eigen::Index>(i)) * blur;
      }
    }
  }
  return share.norm();
}

DiscFit prepareDisc(int radius_px) {
  DiscFit fit;
  std::vector<double> weights;
  for (int y = -radius_px; y <= radius_px; ++y) {
    for (int x = -radius_px; x <= radius_px; ++x) {
      const double weight = radius_px + 1.0 - std::hypot(x, y);
      if (weight <= 0.0) continue;
      fit.offsets.emplace_back(x, y);
      weights.push_back(weight);
    }
  }
  const auto count = static_cast<Eigen::Index>(weights.size());
  Eigen::MatrixXd design(count, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double x = fit.offsets[static_cast<std::size_t>(i)].x();
    const double y = fit.offsets[static_cast<std::size_t>(i)].y();
    design.row(i) << x * x, x * y, y * y, x, y, 1.0;
  }
  const Eigen::Map<const Eigen::VectorXd> weight(weights.data(), count);
  const Eigen::MatrixXd weighted = design.transpose() * weight.asDiagonal();
  const Eigen::MatrixXd all = (weighted * design).inverse() * weighted;
  fit.coefficients_from_samples = all.topRows<5>().cast<float>();
  fit.slope_noise = noiseThroughBlur(fit.offsets, all.row(3).transpose(), radius_px);
  return fit;
}

const DiscFit& discOf(int radius_px) {
  constexpr std::size_t kCount = kMostSaddleRadius_px - kLeastSaddleRadius_px + 1;
  static const std::array<DiscFit, kCount> discs = [] {
    std::array<DiscFit, kCount> prepared;
    for (std::size_t i = 0; i < kCount; ++i) {
      prepared[i] = prepareDisc(kLeastSaddleRadius_px + static_cast<int>(i));
    }
    return prepared;
  }();
  return discs[static_cast<std::size_t>(radius_px - kLeastSaddleRadius_px)];
}

bool discInside(const cv::Mat& picture, const Eigen::Vector2d& centre_px, int radius_px) {
  const double reach = radius_px + 1.0;
  return centre_px.x() >= reach && centre_px.y() >= reach &&
         centre_px.x() <= picture.cols - 1 - reach && centre_px.y() <= picture.rows - 1 - reach;
}

// As many as the largest disc has at most, so that none is allocated.
constexpr int kMostSamples = (2 * kMostSaddleRadius_px + 1) * (2 * kMostSaddleRadius_px + 1);
using Samples = Eigen::Matrix<float, Eigen::Dynamic, 1, 0, kMostSamples, 1>;

struct Quadric {
  Eigen::Matrix2d hessian;
  Eigen::Vector2d slope;  // at the centre of the disc
};

Quadric quadricAround(const cv::Mat& blurred, const Eigen::Vector2d& centre_px,
                      const DiscFit& disc) {
  // All samples lie between the pixels in the same way.
  const int column = static_cast<int>(std::floor(centre_px.x()));
  const int row = static_cast<int>(std::floor(centre_px.y()));
  const auto x = static_cast<float>(centre_px.x() - column);
  const auto y = static_cast<float>(centre_px.y() - row);
  const float k00 = (1.0F - x) * (1.0F - y);
  const float k10 = x * (1.0F - y);
  const float k01 = (1.0F - x) * y;
  const float k11 = x * y;
  Samples samples(static_cast<Eigen::Index>(disc.offsets.size()));
  for (std::size_t i = 0; i < disc.offsets.size(); ++i) {
    const Eigen::Vector2i& offset = disc.offsets[i];
    const float* above = blurred.ptr<float>(row + offset.y()) + column + offset.x();
    const float* below = blurred.ptr<float>(row + offset.y() + 1) + column + offset.x();
    samples[static_cast<Eigen::Index>(i)] =
        k00 * above[0] + k10 * above[1] + k01 * below[0] + k11 * below[1];
  }
  const Eigen::Matrix<double, 5, 1> k = (disc.coefficients_from_samples * samples).cast<double>();
  Quadric quadric;
  quadric.hessian << 2.0 * k[0], k[1], k[1], 2.0 * k[2];
  quadric.slope << k[3], k[4];
  return quadric;
}

}  // namespace

cv::Mat blurredForSaddles(const cv::Mat& grey) {
  GYRE_CHECK(grey.empty() || grey.type() == CV_8U);
  cv::Mat blurred;
  if (grey.empty()) return blurred;
  grey.convertTo(blurred, CV_32F);
  constexpr int kSide_px = 2 * kBlurReach_px + 1;
  cv::GaussianBlur(blurred, blurred, {kSide_px, kSide_px}, kSaddleBlur_px, kSaddleBlur_px,
                   cv::BORDER_REPLICATE);
  return blurred;
}

std::optional<SaddleFit> fitSaddle(const cv::Mat& blurred, const Eigen::Vector2d& start_px,
                                   int radius_px, double noise_grey) {
  GYRE_CHECK(blurred.empty() || blurred.type() == CV_32F);
  const int radius = std::clamp(radius_px, kLeastSaddleRadius_px, kMostSaddleRadius_px);
  const DiscFit& disc = discOf(radius);
  SaddleFit fit;
  fit.pixel = start_px;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!discInside(blurred, fit.pixel, radius)) return std::nullopt;
    const Quadric quadric = quadricAround(blurred, fit.pixel, disc);
    const double determinant = quadric.hessian.determinant();
    if (!(determinant < 0.0)) return std::nullopt;
    // The quadric is stationary where  H delta = -slope.
    const Eigen::Matrix2d inverse = quadric.hessian.inverse();
    Eigen::Vector2d delta = -inverse * quadric.slope;
    // Beyond half the disc the quadric is a guess: go there in steps.
    const double length = delta.norm();
    if (length > 0.5 * radius) delta *= 0.5 * radius / length;
    fit.pixel += delta;
    if (!((fit.pixel - start_px).norm() <= radius)) return std::nullopt;
    // Both slopes carry the same noise, so delta has the covariance  noise^2 H^-1 H^-T.
    fit.sigma_px = std::hypot(noise_grey * disc.slope_noise * inverse.norm() / std::sqrt(2.0),
                              kSystematicSigma_px);
    if (length < kStays_px) break;
  }
  const auto ring = cornerRing(blurred, fit.pixel, std::max<double>(radius, kLeastRing_px));
  if (!ring) return std::nullopt;
  fit.contrast = ring->contrast;
  fit.edge_a = ring->edge_a;
  fit.edge_b = ring->edge_b;
  return fit;
}

std::vector<std::optional<SaddleFit>> refineSaddles(const cv::Mat& grey,
                                                    std::span<const SaddleGuess> guesses) {
  const cv::Mat blurred = blurredForSaddles(grey);
  const double noise_grey = pictureNoise(grey);
  std::vector<std::optional<SaddleFit>> fits;
  fits.reserve(guesses.size());
  for (const SaddleGuess& guess : guesses) {
    fits.push_back(fitSaddle(blurred, guess.pixel, guess.radius_px, noise_grey));
  }
  return fits;
}

}  // namespace gyre
