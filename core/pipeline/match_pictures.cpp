// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/match_pictures.h"

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "core/io/picture_file.h"
#include "core/track/grey_pyramid.h"

namespace gyre {
namespace {

// Of one turn in more views than this, some are skipped to tell the step's size: 15 degrees.
constexpr std::size_t kWideViews = 24;

Result<ViewSpots> spotsOf(const PictureView& view) {
  auto frame = readPicture(view.file);
  if (!frame) return frame.error();
  cv::Mat mask;
  if (!view.mask.empty()) {
    auto read = readMask(view.mask);
    if (!read) return read.error();
    mask = std::move(*read);
    if (mask.size() != frame->image_bgr.size()) mask.release();  // refused later, in words
  }
  return findSpots(greyOf(frame->image_bgr), mask);
}

}  // namespace

Result<MatchedPictures> matchPictures(const std::vector<PictureView>& views, const Task& task) {
  const std::size_t count = views.size();
  MatchedPictures matched;
  matched.stride = std::max<std::size_t>(1, count / kWideViews);
  std::deque<ViewSpots> before;  // the last views, the newest at the end
  ViewSpots first;
  for (std::size_t i = 0; i < count; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(
        static_cast<double>(i) / static_cast<double>(count),
        "Comparing pictures, view " + std::to_string(i + 1) + " of " + std::to_string(count));
    auto spots = spotsOf(views[i]);
    if (!spots) return spots.error();
    if (i == 0) first = *spots;
    if (i > 0) matched.pairs.push_back(matchSpots(before.back(), *spots));
    if (before.size() == matched.stride) {
      if (matched.stride > 1) matched.wide.push_back(matchSpots(before.front(), *spots));
      before.pop_front();
    }
    if (i > 1 && i + 1 == count) matched.closing = matchSpots(*spots, first);
    before.push_back(std::move(*spots));
  }
  return matched;
}

std::vector<ViewMatch> undistorted(const CameraModel& camera, std::span<const PixelMatch> pixels) {
  std::vector<ViewMatch> matches;
  matches.reserve(pixels.size());
  for (const PixelMatch& each : pixels) {
    matches.push_back(
        {camera.normalizedFromPixel(each.first), camera.normalizedFromPixel(each.second)});
  }
  return matches;
}

}  // namespace gyre
