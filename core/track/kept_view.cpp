// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/kept_view.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/track/grey_pyramid.h"

namespace gyre {

KeptView keepView(const cv::Mat& image_bgr, const cv::Mat& object_mask) {
  KeptView kept;
  kept.grey = greyOf(image_bgr);
  kept.noise_sigma = estimateNoiseSigma(kept.grey, object_mask);
  cv::Mat half;
  cv::resize(image_bgr, half, {(image_bgr.cols + 1) / 2, (image_bgr.rows + 1) / 2}, 0.0, 0.0,
             cv::INTER_AREA);
  cv::cvtColor(half, half, cv::COLOR_BGR2YCrCb);
  kept.chroma.create(half.size(), CV_8UC2);
  cv::mixChannels({half}, {kept.chroma}, {1, 0, 2, 1});
  return kept;
}

Rgb colourAt(const KeptView& view, const Eigen::Vector2d& pixel) {
  const int column = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, view.grey.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, view.grey.rows - 1);
  const auto& chroma = view.chroma.at<cv::Vec2b>(row / 2, column / 2);
  // ITU-R BT.601, as the grey was made.
  const double y = view.grey.at<std::uint8_t>(row, column);
  const double cr = chroma[0] - 128.0;
  const double cb = chroma[1] - 128.0;
  const auto level = [](double value) { return cv::saturate_cast<std::uint8_t>(value); };
  return {level(y + 1.403 * cr), level(y - 0.714 * cr - 0.344 * cb), level(y + 1.773 * cb)};
}

}  // namespace gyre
