// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/view_matches.h"

#include <opencv2/features2d.hpp>

namespace gyre {
namespace {

constexpr int kMostSpots = 1500;
constexpr float kClearlyNearer = 0.8F;  // of the distances of the nearest and the next
constexpr double kStandsStill_px = 1.0;

// For each row of `from` the nearest row of `to`, or -1 when another is nearly as near.
std::vector<int> clearlyNearest(const cv::Mat& from, const cv::Mat& to) {
  std::vector<int> nearest(static_cast<std::size_t>(from.rows), -1);
  if (from.rows == 0 || to.rows < 2) return nearest;
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(from, to, found, 2);
  for (const auto& each : found) {
    if (each.size() == 2 && each[0].distance < kClearlyNearer * each[1].distance) {
      nearest[static_cast<std::size_t>(each[0].queryIdx)] = each[0].trainIdx;
    }
  }
  return nearest;
}

}  // namespace

ViewSpots findSpots(const cv::Mat& grey, const cv::Mat& object_mask) {
  std::vector<cv::KeyPoint> keypoints;
  ViewSpots spots;
  cv::SIFT::create(kMostSpots)->detectAndCompute(grey, object_mask, keypoints, spots.descriptors);
  spots.pixels.reserve(keypoints.size());
  for (const cv::KeyPoint& each : keypoints) spots.pixels.emplace_back(each.pt.x, each.pt.y);
  return spots;
}

std::vector<PixelMatch> matchSpots(const ViewSpots& first, const ViewSpots& second) {
  const std::vector<int> there = clearlyNearest(first.descriptors, second.descriptors);
  const std::vector<int> back = clearlyNearest(second.descriptors, first.descriptors);
  std::vector<PixelMatch> matches;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (there[i] < 0) continue;
    const auto k = static_cast<std::size_t>(there[i]);
    if (back[k] != static_cast<int>(i)) continue;
    if ((first.pixels[i] - second.pixels[k]).norm() < kStandsStill_px) continue;
    matches.push_back({first.pixels[i], second.pixels[k]});
  }
  return matches;
}

}  // namespace gyre
