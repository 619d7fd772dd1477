// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/klt_step.h"

#include <cmath>

#include <opencv2/video/tracking.hpp>

namespace gyre {
namespace {

// The prediction is good to a pixel or two: one coarser level is enough to be safe.
constexpr int kLevels = 1;
const cv::TermCriteria kStopping(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.005);

cv::Point2f cvPoint(const Eigen::Vector2f& pixel) { return {pixel.x(), pixel.y()}; }

// Moves `to` from the prediction to where the features are; gives 1 for each that was found.
std::vector<std::uint8_t> follow(const GreyPyramid& first, const GreyPyramid& second, int window_px,
                                 const std::vector<cv::Point2f>& from,
                                 std::vector<cv::Point2f>& to) {
  std::vector<std::uint8_t> found;
  std::vector<float> unused_error;
  cv::calcOpticalFlowPyrLK(first.levels, second.levels, from, to, found, unused_error,
                           {window_px, window_px}, kLevels, kStopping,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  return found;
}

}  // namespace

std::vector<KltOutcome> kltStep(const GreyPyramid& first, const GreyPyramid& second,
                                std::span<const KltMove> moves, int window_px) {
  if (moves.empty()) return {};
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  for (const KltMove& move : moves) {
    from.push_back(cvPoint(move.from));
    to.push_back(cvPoint(move.predicted));
  }
  const auto found = follow(first, second, window_px, from, to);
  std::vector<cv::Point2f> back = from;
  const auto found_back = follow(second, first, window_px, to, back);

  std::vector<KltOutcome> outcomes(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    outcomes[i].to = {to[i].x, to[i].y};
    outcomes[i].round_trip_px = std::hypot(back[i].x - from[i].x, back[i].y - from[i].y);
    outcomes[i].found = found[i] != 0 && found_back[i] != 0;
  }
  return outcomes;
}

}  // namespace gyre
