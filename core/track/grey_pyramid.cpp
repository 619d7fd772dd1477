// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/grey_pyramid.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kMaxLevel = 2;
constexpr int kBlock_px = 16;
// A camera's own rounding to whole grey levels leaves this much.
constexpr double kLeastNoise = 0.3;

// The picture's blocks that hold a part of it.
cv::Rect blocksAround(const cv::Rect& part, const cv::Size& size) {
  const cv::Point begin(part.x / kBlock_px * kBlock_px, part.y / kBlock_px * kBlock_px);
  const cv::Point end((part.br().x + kBlock_px - 1) / kBlock_px * kBlock_px,
                      (part.br().y + kBlock_px - 1) / kBlock_px * kBlock_px);
  return cv::Rect(begin, end) & cv::Rect({}, size);
}

// How much each block that the area covers (all, when it is empty) differs from smoothness.
std::vector<float> blockResponses(const cv::Mat& grey, const cv::Mat& area) {
  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat response;
  cv::filter2D(grey, response, CV_32F, kernel);
  const cv::Size blocks_size(std::max(1, grey.cols / kBlock_px),
                             std::max(1, grey.rows / kBlock_px));
  cv::Mat blocks;
  cv::resize(cv::abs(response), blocks, blocks_size, 0, 0, cv::INTER_AREA);
  cv::Mat covered(blocks_size, CV_8U, cv::Scalar(255));
  if (!area.empty()) cv::resize(area != 0, covered, blocks_size, 0, 0, cv::INTER_AREA);

  std::vector<float> values;
  for (int row = 0; row < blocks.rows; ++row) {
    for (int column = 0; column < blocks.cols; ++column) {
      if (covered.at<std::uint8_t>(row, column) > 250) {
        values.push_back(blocks.at<float>(row, column));
      }
    }
  }
  return values;
}

}  // namespace

double estimateNoiseSigma(const cv::Mat& grey, const cv::Mat& area) {
  std::vector<float> values;
  if (!area.empty()) {
    const cv::Rect part = blocksAround(cv::boundingRect(area), grey.size());
    if (!part.empty()) values = blockResponses(grey(part), area(part));
  }
  if (values.empty()) values = blockResponses(grey, {});
  const auto tenth = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
  std::nth_element(values.begin(), tenth, values.end());
  return std::max(kLeastNoise, std::sqrt(kPi / 2.0) / 6.0 * static_cast<double>(*tenth));
}

cv::Mat greyOf(const cv::Mat& image_bgr) {
  cv::Mat grey;
  cv::cvtColor(image_bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

GreyPyramid buildGreyPyramid(const cv::Mat& image_bgr, int window_px) {
  GreyPyramid pyramid;
  pyramid.grey = greyOf(image_bgr);
  cv::buildOpticalFlowPyramid(pyramid.grey, pyramid.levels, {window_px, window_px}, kMaxLevel);
  return pyramid;
}

}  // namespace gyre
