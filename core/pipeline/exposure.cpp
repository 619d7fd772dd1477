// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/exposure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <opencv2/core.hpp>

#include "core/base/check.h"

namespace gyre {
namespace {

// A little short of the limits: sensors and codecs seldom reach 255 and 0 exactly.
constexpr std::uint8_t kWhite = 252;
constexpr std::uint8_t kBlack = 6;
constexpr double kTooMuch = 0.05;

}  // namespace

Exposure exposureOf(const cv::Mat& image_bgr) {
  return exposureOf(image_bgr, cv::Mat(image_bgr.size(), CV_8U, cv::Scalar(255)));
}

Exposure exposureOf(const cv::Mat& image_bgr, const cv::Mat& area) {
  GYRE_CHECK(image_bgr.type() == CV_8UC3 && !image_bgr.empty());
  GYRE_CHECK(area.type() == CV_8U && area.size() == image_bgr.size());
  std::size_t all = 0;
  std::size_t white = 0;
  std::size_t black = 0;
  for (int row = 0; row < image_bgr.rows; ++row) {
    const auto* pixels = image_bgr.ptr<cv::Vec3b>(row);
    const auto* counts = area.ptr<std::uint8_t>(row);
    for (int column = 0; column < image_bgr.cols; ++column) {
      if (counts[column] == 0) continue;
      ++all;
      const cv::Vec3b& bgr = pixels[column];
      const std::uint8_t brightest = std::max({bgr[0], bgr[1], bgr[2]});
      if (brightest >= kWhite) ++white;
      if (brightest <= kBlack) ++black;
    }
  }
  if (all == 0) return {};
  const auto total = static_cast<double>(all);
  return {static_cast<double>(white) / total, static_cast<double>(black) / total};
}

std::string exposureAdvice(const Exposure& exposure) {
  if (exposure.too_bright > kTooMuch) {
    return "White areas hold no detail: dim the light or expose shorter.";
  }
  if (exposure.too_dark > kTooMuch) {
    return "Black areas hold no detail: add light or expose longer.";
  }
  return {};
}

}  // namespace gyre
