// The gap after a full turn: what slipped steps, a bumped camera or a moved object leave behind.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/track/grey_pyramid.h"
#include "core/track/options.h"

namespace gyre {

// A feature of the last view that was found again in the first one.
struct ReturnedFeature {
  std::size_t late = 0;  // index into the late features
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

struct TurnGap {
  double px = 0.0;  // median distance in the first picture
  double mm = 0.0;  // the same on the object
  std::size_t features = 0;
  std::vector<ReturnedFeature> returned;  // those features
};

// A feature of the last view, with its point as only the late views place it.
struct LateFeature {
  Eigen::Vector2d last_pixel;
  Eigen::Vector3d position_in_table;  // mm
};

// The two ends of a turn.
struct TurnEnds {
  const GreyPyramid& last;
  const GreyPyramid& first;
  const CameraModel& camera;
  const Rigid3& first_cam_from_table;
};

// Finds the late features in the first picture and measures how far they lie from where their
// points should appear there. Nothing when fewer than ten are found. Any thread.
std::optional<TurnGap> measureTurnGap(const TurnEnds& ends, std::span<const LateFeature> late,
                                      const TrackOptions& options);

}  // namespace gyre
