// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/feature_detector.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

// Variance of the filter's output for white noise of variance 1: 2 (3^2 + 10^2 + 3^2) / 32^2.
constexpr double kScharrNoiseGain = 236.0 / 1024.0;

// Smaller eigenvalue of the gradients' structure tensor summed over the window, per pixel.
cv::Mat smallerEigenvalues(const cv::Mat& grey, int window_px) {
  cv::Mat dx;
  cv::Mat dy;
  // Scharr's weights sum to 32 per grey level and pixel.
  cv::Scharr(grey, dx, CV_32F, 1, 0, 1.0 / 32.0);
  cv::Scharr(grey, dy, CV_32F, 0, 1, 1.0 / 32.0);
  const cv::Size window(window_px, window_px);
  cv::Mat xx;
  cv::Mat xy;
  cv::Mat yy;
  cv::boxFilter(dx.mul(dx), xx, CV_32F, window, {-1, -1}, false);
  cv::boxFilter(dx.mul(dy), xy, CV_32F, window, {-1, -1}, false);
  cv::boxFilter(dy.mul(dy), yy, CV_32F, window, {-1, -1}, false);
  cv::Mat smaller(grey.size(), CV_32F);
  for (int row = 0; row < grey.rows; ++row) {
    const float* a = xx.ptr<float>(row);
    const float* b = xy.ptr<float>(row);
    const float* c = yy.ptr<float>(row);
    float* out = smaller.ptr<float>(row);
    for (int column = 0; column < grey.cols; ++column) {
      const float half_sum = 0.5F * (a[column] + c[column]);
      const float half_difference = 0.5F * (a[column] - c[column]);
      out[column] = half_sum - std::sqrt(half_difference * half_difference + b[column] * b[column]);
    }
  }
  return smaller;
}

}  // namespace

std::vector<Feature> detectFeatures(const cv::Mat& grey, double noise_sigma, const cv::Mat& allowed,
                                    std::span<const Eigen::Vector2d> occupied,
                                    const TrackOptions& options) {
  const cv::Rect region = cv::boundingRect(allowed);
  std::vector<Feature> features;
  if (region.empty()) return features;
  const cv::Mat smaller = smallerEigenvalues(grey(region), options.window_px);

  const int spacing = options.feature_spacing_px;
  const int columns = (grey.cols + spacing - 1) / spacing;
  const int rows = (grey.rows + spacing - 1) / spacing;
  cv::Mat taken = cv::Mat::zeros(rows, columns, CV_8U);
  for (const Eigen::Vector2d& pixel : occupied) {
    const int column = static_cast<int>(pixel.x()) / spacing;
    const int row = static_cast<int>(pixel.y()) / spacing;
    if (column >= 0 && row >= 0 && column < columns && row < rows)
      taken.at<std::uint8_t>(row, column) = 1;
  }

  const double variance = 2.0 * noise_sigma * noise_sigma;
  // Noise has gradients of its own: what Scharr's filter makes of it must not count as texture.
  const double noise_part =
      kScharrNoiseGain * noise_sigma * noise_sigma * options.window_px * options.window_px;
  const double floor = variance / (options.max_sigma_px * options.max_sigma_px);
  for (int cell_row = region.y / spacing; cell_row < rows; ++cell_row) {
    for (int cell_column = region.x / spacing; cell_column < columns; ++cell_column) {
      if (taken.at<std::uint8_t>(cell_row, cell_column) != 0) continue;
      const cv::Rect cell =
          cv::Rect(cell_column * spacing, cell_row * spacing, spacing, spacing) & region;
      if (cell.empty()) continue;
      double best = 0.0;
      cv::Point where;
      cv::minMaxLoc(smaller(cell - region.tl()), nullptr, &best, nullptr, &where, allowed(cell));
      best -= noise_part;
      if (best < floor) continue;
      const cv::Point at = where + cell.tl();
      features.push_back({{at.x, at.y}, std::sqrt(variance / best)});
    }
  }
  return features;
}

}  // namespace gyre
