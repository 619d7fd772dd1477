// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/edge_width.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/track/grey_pyramid.h"

namespace gyre {
namespace {

constexpr double kSmoothing_px = 1.0;  // takes noise out before anything else
constexpr double kReblur_px = 2.0;
constexpr double kQuantile = 0.4;
constexpr std::size_t kLeastEdges = 40;
// What smoothing by 1 px leaves of the noise's gradient: 1 / (sqrt(8 pi) s^2) of its sigma.
constexpr double kNoiseLeft = 0.2;
constexpr double kSigmas = 8.0;
constexpr double kLeastGradient = 1.5;  // grey levels a pixel: rounding and JPEG blocks

struct Gradients {
  cv::Mat x;
  cv::Mat y;
  cv::Mat size;
};

Gradients gradientsOf(const cv::Mat& grey, double sigma_px) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, {}, sigma_px);
  Gradients found;
  cv::Scharr(smooth, found.x, CV_32F, 1, 0, 1.0 / 32.0);
  cv::Scharr(smooth, found.y, CV_32F, 0, 1, 1.0 / 32.0);
  cv::magnitude(found.x, found.y, found.size);
  return found;
}

// Whether the gradient is the largest along its own direction: the edge runs here.
bool isCrest(const Gradients& of, int row, int column) {
  const float size = of.size.at<float>(row, column);
  const float x = of.x.at<float>(row, column) / size;
  const float y = of.y.at<float>(row, column) / size;
  const int dx = static_cast<int>(std::lround(x));
  const int dy = static_cast<int>(std::lround(y));
  return size >= of.size.at<float>(row + dy, column + dx) &&
         size > of.size.at<float>(row - dy, column - dx);
}

}  // namespace

std::optional<double> edgeWidthPx(const cv::Mat& image_bgr, const cv::Mat& area) {
  GYRE_CHECK(area.type() == CV_8U && area.size() == image_bgr.size());
  const cv::Rect whole({}, image_bgr.size());
  cv::Rect region = cv::boundingRect(area);
  if (region.empty()) return std::nullopt;
  const cv::Mat grey_8 = greyOf(image_bgr);
  const double noise = estimateNoiseSigma(grey_8, area);
  constexpr int kSurround_px = 8;
  region = cv::Rect(region.x - kSurround_px, region.y - kSurround_px,
                    region.width + 2 * kSurround_px, region.height + 2 * kSurround_px) &
           whole;
  cv::Mat grey;
  grey_8(region).convertTo(grey, CV_32F);
  const cv::Mat counts = area(region);
  const Gradients sharp = gradientsOf(grey, kSmoothing_px);
  const Gradients soft = gradientsOf(grey, std::hypot(kSmoothing_px, kReblur_px));
  const double floor = std::max(kLeastGradient, kSigmas * kNoiseLeft * noise);
  std::vector<double> widths;
  for (int row = 1; row + 1 < grey.rows; ++row) {
    for (int column = 1; column + 1 < grey.cols; ++column) {
      const auto size = static_cast<double>(sharp.size.at<float>(row, column));
      if (counts.at<std::uint8_t>(row, column) == 0 || size < floor) continue;
      if (!isCrest(sharp, row, column)) continue;
      const double ratio =
          size / std::max(1e-6, static_cast<double>(soft.size.at<float>(row, column)));
      // R^2 = (s^2 + n^2 + r^2) / (s^2 + n^2), with n smoothed before: solved for s.
      const double softened = std::max(1e-6, ratio * ratio - 1.0);
      const double squared = kReblur_px * kReblur_px / softened - kSmoothing_px * kSmoothing_px;
      widths.push_back(std::sqrt(std::max(0.0, squared)));
    }
  }
  if (widths.size() < kLeastEdges) return std::nullopt;
  const auto at = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(widths.size()));
  std::nth_element(widths.begin(), widths.begin() + at, widths.end());
  return widths[static_cast<std::size_t>(at)];
}

}  // namespace gyre
