// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/settling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/median.h"

namespace gyre {
namespace {

// The first views are all watched, later ones now and then: a load may shift, a belt slacken.
constexpr int kFirstViewsWatched = 3;
constexpr int kWatchEvery = 20;
constexpr double kLongestSwing_s = 2.5;
constexpr double kFixedDelay_s = 0.6;  // what users of swinging tables set by hand
constexpr double kDelayMargin = 1.25;  // over the longest time seen

// Averaging over 4 x 4 pixels of a usual picture takes most noise out and leaves a swing of half a
// pixel visible at every textured place.
constexpr int kWatchedWidth_px = 320;
constexpr double kSigmas = 6.0;
constexpr double kSmallestStep = 1.5;     // grey levels: rounding and JPEG blocks
constexpr double kSmallestShare = 0.002;  // of the picture: a tenth of a small object's area

cv::Mat smallGrey(const cv::Mat& image_bgr) {
  cv::Mat grey;
  cv::cvtColor(image_bgr, grey, cv::COLOR_BGR2GRAY);
  const double scale = std::min(1.0, static_cast<double>(kWatchedWidth_px) / grey.cols);
  cv::Mat small;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat exact;
  small.convertTo(exact, CV_32F);
  return exact;
}

}  // namespace

bool somethingMoved(const cv::Mat& before_bgr, const cv::Mat& after_bgr) {
  GYRE_CHECK(before_bgr.size() == after_bgr.size());
  const cv::Mat change = smallGrey(after_bgr) - smallGrey(before_bgr);
  std::vector<float> values(change.begin<float>(), change.end<float>());
  const float brightening = median(values);
  for (float& value : values) value = std::abs(value - brightening);
  // Most of the picture stands still, so the median difference is noise: sigma = 1.48 of it.
  const double noise = 1.4826 * static_cast<double>(median(values));
  const double limit = std::max(kSmallestStep, kSigmas * noise);
  const auto moved = std::count_if(values.begin(), values.end(),
                                   [&](float value) { return static_cast<double>(value) > limit; });
  return static_cast<double>(moved) > kSmallestShare * static_cast<double>(values.size());
}

Settling::Settling(double known_s)
    : known_s_(std::clamp(known_s, 0.0, kLongestSwing_s)), delay_s_(known_s_) {}

Result<FramePtr> Settling::grabStill(Camera& camera, double stood_s, const Task& task) {
  const bool due = views_ < kFirstViewsWatched || views_ % kWatchEvery == 0;
  ++views_;
  if (due && watching_helps_) return watch(camera, stood_s, task);
  return camera.grabAfter(stood_s + delay_s_, task);
}

Result<FramePtr> Settling::watch(Camera& camera, double stood_s, const Task& task) {
  Result<FramePtr> before = camera.grabAfter(stood_s + known_s_, task);
  double still_since_s = stood_s;
  // Once a swing is seen, one still pair may be its turning point; two in a row are not.
  int still_pairs_needed = 1;
  while (before) {
    Result<FramePtr> after = camera.grabAfter((*before)->time_s, task);
    if (!after || (*after)->image_bgr.size() != (*before)->image_bgr.size()) return after;
    if (somethingMoved((*before)->image_bgr, (*after)->image_bgr)) {
      still_pairs_needed = 2;
      still_since_s = (*after)->time_s;
    } else if (--still_pairs_needed == 0) {
      delay_s_ = std::max(delay_s_, kDelayMargin * (still_since_s - stood_s));
      return after;
    }
    if ((*after)->time_s - stood_s > kLongestSwing_s) {
      watching_helps_ = false;
      delay_s_ = std::max(delay_s_, kFixedDelay_s);
      return after;
    }
    before = std::move(after);
  }
  return before;
}

}  // namespace gyre
