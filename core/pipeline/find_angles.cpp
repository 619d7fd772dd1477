// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_angles.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "core/io/picture_file.h"
#include "core/track/grey_pyramid.h"
#include "core/track/search_volume.h"
#include "core/track/view_matches.h"

namespace gyre {
namespace {

constexpr double kTolerance_px = 1.0;
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

std::vector<ViewMatch> matchesOf(const CameraModel& camera, const ViewSpots& first,
                                 const ViewSpots& second) {
  std::vector<ViewMatch> matches;
  for (const PixelMatch& each : matchSpots(first, second)) {
    matches.push_back(
        {camera.normalizedFromPixel(each.first), camera.normalizedFromPixel(each.second)});
  }
  return matches;
}

// The matches of all views, each with the next and with one further on.
Result<TurnMatches> matchViews(const PreparedPictures& prepared, const Task& task) {
  const CameraModel& camera = prepared.calibration.calibration.camera;
  const std::size_t count = prepared.views.size();
  TurnMatches matches;
  matches.stride = std::max<std::size_t>(1, count / kWideViews);
  std::deque<ViewSpots> before;  // the last views, the newest at the end
  ViewSpots first;
  for (std::size_t i = 0; i < count; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(count),
                "Finding the table's steps, view " + std::to_string(i + 1) + " of " +
                    std::to_string(count));
    auto spots = spotsOf(prepared.views[i]);
    if (!spots) return spots.error();
    if (i == 0) first = *spots;
    if (i > 0) matches.pairs.push_back(matchesOf(camera, before.back(), *spots));
    if (before.size() == matches.stride) {
      const auto wide =
          matches.stride == 1 ? matches.pairs.back() : matchesOf(camera, before.front(), *spots);
      matches.wide.insert(matches.wide.end(), wide.begin(), wide.end());
      before.pop_front();
    }
    if (i > 1 && i + 1 == count) matches.closing = matchesOf(camera, *spots, first);
    before.push_back(std::move(*spots));
  }
  return matches;
}

}  // namespace

Result<TurnSteps> findAngles(PreparedPictures& prepared, const Task& task) {
  const auto matches = matchViews(prepared, task);
  if (!matches) return matches.error();
  const CameraModel& camera = prepared.calibration.calibration.camera;
  const Rigid3& cam_from_table = *prepared.calibration.calibration.cam_from_table;
  TurnStepsOptions options;
  options.tolerance = kTolerance_px / std::sqrt(camera.fx * camera.fy);
  options.most_radius_mm = visibleVolume(camera, cam_from_table).radius_mm;
  auto steps = turnSteps(*matches, cam_from_table, options);
  if (!steps) return steps;
  const std::size_t count = prepared.views.size();
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    prepared.views[i].table_angle_rad = angle_rad;
    if (i + 1 < count) angle_rad += steps->steps_rad[i];
  }
  std::stable_sort(prepared.views.begin(), prepared.views.end(),
                   [](const PictureView& a, const PictureView& b) {
                     return a.table_angle_rad < b.table_angle_rad;
                   });
  return steps;
}

}  // namespace gyre
