// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/picture_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/corners/saddle_fit.h"

namespace gyre {
namespace {

constexpr int kWhite = 252;
constexpr double kLeastContrast = 12.0;
constexpr int kReach_px = 9;  // to either side of an edge, within which its contrast is taken

double percentileOf(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void measureExposure(const cv::Mat& grey, PictureQuality& quality) {
  std::array<std::size_t, 256> histogram{};
  for (int y = 0; y < grey.rows; ++y) {
    const auto* row = grey.ptr<unsigned char>(y);
    for (int x = 0; x < grey.cols; ++x) ++histogram[row[x]];
  }
  const auto total = static_cast<double>(grey.total());
  double above = 0.0;
  for (int level = 255; level >= 0; --level) {
    above += static_cast<double>(histogram[static_cast<std::size_t>(level)]) / total;
    if (level == kWhite) quality.white_share = above;
    if (above >= 0.01 && quality.brightest == 0.0) quality.brightest = level;
  }
}

}  // namespace

PictureQuality measureQuality(const TargetPicture& picture) {
  PictureQuality quality;
  measureExposure(picture.grey, quality);
  cv::Mat dx;
  cv::Mat dy;
  cv::Mat slope;
  cv::Sobel(picture.blurred, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(picture.blurred, dy, CV_32F, 0, 1, 3, 0.125);
  cv::magnitude(dx, dy, slope);
  const cv::Mat around =
      cv::getStructuringElement(cv::MORPH_RECT, {2 * kReach_px + 1, 2 * kReach_px + 1});
  cv::Mat most;
  cv::Mat least;
  cv::Mat steepest;
  cv::dilate(picture.blurred, most, around);
  cv::erode(picture.blurred, least, around);
  cv::dilate(slope, steepest, around);
  const cv::Mat contrast = most - least;
  std::vector<float> contrasts;
  for (int y = 0; y < slope.rows; y += 4) {
    for (int x = 0; x < slope.cols; x += 4) contrasts.push_back(contrast.at<float>(y, x));
  }
  if (contrasts.empty()) return quality;
  // The strongest few tell what contrast the picture has, however small its subject.
  const double strong = percentileOf(contrasts, 0.998);
  const double noise = 6.0 * picture.noise_grey / (2.0 * std::sqrt(kPi) * kSaddleBlur_px);
  if (strong < std::max(kLeastContrast, 1.5 * noise)) return quality;
  quality.contrast = strong;
  std::vector<float> scales;
  for (int y = kReach_px; y < slope.rows - kReach_px; ++y) {
    for (int x = kReach_px; x < slope.cols - kReach_px; ++x) {
      const double c = contrast.at<float>(y, x);
      const double g = slope.at<float>(y, x);
      if (c < 0.7 * strong || g < steepest.at<float>(y, x)) continue;
      scales.push_back(static_cast<float>(c / (g * std::sqrt(kTurn_rad))));
    }
  }
  if (scales.empty()) return quality;
  const double seen_px = percentileOf(scales, 0.5);
  // The blur that we added ourselves is not the picture's.
  quality.blur_px = std::sqrt(std::max(0.0, seen_px * seen_px - kSaddleBlur_px * kSaddleBlur_px));
  return quality;
}

}  // namespace gyre
