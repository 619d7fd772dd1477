// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/mask_cleaning.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

// A pixel counts when this share of its neighbourhood has changed: texture on texture leaves many
// pixels of the object as they were by chance.
constexpr double kLeastDensity = 0.3;
// Parts below this share of the largest one are specks.
constexpr double kLeastPart = 0.05;

struct Part {
  int area = 0;
  bool touches_border = false;
};

// Paints every connected part of `of` for which keep(part) holds into `into`.
template <class Keep>
void paintParts(const cv::Mat& of, const Keep& keep, cv::Mat& into) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(of, labels, stats, centroids, 4);
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(count), 0);
  for (int i = 1; i < count; ++i) {
    const int left = stats.at<int>(i, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(i, cv::CC_STAT_TOP);
    const bool touches_border = left == 0 || top == 0 ||
                                left + stats.at<int>(i, cv::CC_STAT_WIDTH) == of.cols ||
                                top + stats.at<int>(i, cv::CC_STAT_HEIGHT) == of.rows;
    const Part part{stats.at<int>(i, cv::CC_STAT_AREA), touches_border};
    wanted[static_cast<std::size_t>(i)] = keep(part) ? 1 : 0;
  }
  for (int row = 0; row < of.rows; ++row) {
    const int* label = labels.ptr<int>(row);
    std::uint8_t* out = into.ptr<std::uint8_t>(row);
    for (int column = 0; column < of.cols; ++column) {
      if (wanted[static_cast<std::size_t>(label[column])] != 0) out[column] = 255;
    }
  }
}

int largestPart(const cv::Mat& of) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(of, labels, stats, centroids, 4);
  int largest = 0;
  for (int i = 1; i < count; ++i) largest = std::max(largest, stats.at<int>(i, cv::CC_STAT_AREA));
  return largest;
}

}  // namespace

cv::Mat cleanMask(const cv::Mat& changed, double max_hole_share) {
  const int radius = std::max(2, changed.cols / 240);
  cv::Mat density;
  cv::boxFilter(changed, density, CV_32F, {2 * radius + 1, 2 * radius + 1});
  cv::Mat solid = density > kLeastDensity * 255.0;
  const auto disc = [](int size) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * size + 1, 2 * size + 1});
  };
  cv::morphologyEx(solid, solid, cv::MORPH_CLOSE, disc(2 * radius));
  cv::morphologyEx(solid, solid, cv::MORPH_OPEN, disc(radius));

  const int largest = largestPart(solid);
  cv::Mat mask = cv::Mat::zeros(solid.size(), CV_8U);
  paintParts(
      solid, [&](const Part& part) { return part.area >= kLeastPart * largest; }, mask);
  // What touches no border of the picture and is not object is a hole, or the gap in a handle.
  const cv::Mat gaps = mask == 0;
  const double most = max_hole_share * largest;
  paintParts(
      gaps, [&](const Part& part) { return !part.touches_border && part.area <= most; }, mask);
  return mask;
}

}  // namespace gyre
