// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/moving_mask.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/track/grey_pyramid.h"
#include "core/track/mask_cleaning.h"

namespace gyre {
namespace {

constexpr int kWorkingWidth_px = 320;
constexpr std::size_t kMostRemembered = 24;
constexpr std::size_t kLeastRemembered = 6;
constexpr double kFlicker = 0.04;

}  // namespace

cv::Mat MovingMask::median() const {
  cv::Mat result(remembered_bgr_.front().size(), CV_8UC3);
  const std::size_t n = remembered_bgr_.size();
  std::vector<std::uint8_t> values(n);
  const int bytes = result.cols * 3;
  for (int row = 0; row < result.rows; ++row) {
    std::uint8_t* out = result.ptr<std::uint8_t>(row);
    for (int i = 0; i < bytes; ++i) {
      for (std::size_t k = 0; k < n; ++k) values[k] = remembered_bgr_[k].ptr<std::uint8_t>(row)[i];
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
      std::nth_element(values.begin(), middle, values.end());
      out[i] = *middle;
    }
  }
  return result;
}

cv::Mat MovingMask::addFrame(const Frame& frame) {
  const double scale = std::min(1.0, static_cast<double>(kWorkingWidth_px) / frame.image_bgr.cols);
  cv::Mat small;
  cv::resize(frame.image_bgr, small, {}, scale, scale, cv::INTER_AREA);
  if (frames_seen_++ % stride_ == 0) {
    remembered_bgr_.push_back(small);
    if (remembered_bgr_.size() > kMostRemembered) {
      // Thin out to every second one, so that those kept still spread over the whole scan.
      std::deque<cv::Mat> thinned;
      for (std::size_t i = 0; i < remembered_bgr_.size(); i += 2) {
        thinned.push_back(remembered_bgr_[i]);
      }
      remembered_bgr_ = std::move(thinned);
      stride_ *= 2;
    }
  }
  cv::Mat everything(frame.image_bgr.size(), CV_8U, cv::Scalar(255));
  if (remembered_bgr_.size() < kLeastRemembered) return everything;

  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  const double threshold = 4.0 + 4.0 * estimateNoiseSigma(grey) + kFlicker * cv::mean(grey)[0];
  cv::Mat difference;
  cv::absdiff(small, median(), difference);
  cv::Mat channels[3];
  cv::split(difference, channels);
  const cv::Mat changed = cv::max(channels[0], cv::max(channels[1], channels[2])) > threshold;
  const cv::Mat mask = cleanMask(changed, 1.0);
  cv::Mat full;
  cv::resize(mask, full, frame.image_bgr.size(), 0, 0, cv::INTER_LINEAR);
  return full > 127;
}

}  // namespace gyre
