// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_angles.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/track/search_volume.h"

namespace gyre {
namespace {

constexpr double kTolerance_px = 1.0;

TurnMatches undistorted(const CameraModel& camera, const MatchedPictures& matched) {
  TurnMatches matches;
  matches.stride = matched.stride;
  for (const auto& pair : matched.pairs) matches.pairs.push_back(undistorted(camera, pair));
  for (const auto& pair : matched.apart()) {
    const auto wide = undistorted(camera, pair);
    matches.wide.insert(matches.wide.end(), wide.begin(), wide.end());
  }
  matches.closing = undistorted(camera, matched.closing);
  return matches;
}

}  // namespace

Result<TurnSteps> findAngles(PreparedPictures& prepared, const MatchedPictures& matched) {
  const CameraModel& camera = prepared.calibration.calibration.camera;
  const Rigid3& cam_from_table = *prepared.calibration.calibration.cam_from_table;
  const TurnMatches matches = undistorted(camera, matched);
  TurnStepsOptions options;
  options.tolerance = kTolerance_px / std::sqrt(camera.fx * camera.fy);
  options.most_radius_mm = visibleVolume(camera, cam_from_table).radius_mm;
  auto steps = turnSteps(matches, cam_from_table, options);
  if (!steps) return steps;
  const std::size_t count = prepared.views.size();
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    prepared.views[i].table_angle_rad = angle_rad;
    if (i + 1 < count) angle_rad += steps->steps_rad[i];
  }
  prepared.angles_told = true;
  std::stable_sort(prepared.views.begin(), prepared.views.end(),
                   [](const PictureView& a, const PictureView& b) {
                     return a.table_angle_rad < b.table_angle_rad;
                   });
  return steps;
}

}  // namespace gyre
