// What a sighting must fulfil to be believed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/recover/point_estimator.h"
#include "core/scan/frame.h"
#include "core/scan/track.h"
#include "core/track/options.h"
#include "core/track/search_volume.h"

namespace gyre {

// 255 where a feature may be: on the object, not near its outline, not near the picture's edge.
cv::Mat allowedArea(const cv::Mat& object_mask, const TrackOptions& options);

// The view in which a sighting was made.
struct ViewGeometry {
  const CameraModel& camera;
  const Rigid3& cam_from_table;
  const SearchVolume& volume;
};

// Whether the latest sighting of a track fits the point that all of them together give: on the
// object rather than the platter, and where the table's turning puts it. sightings_before: how many
// there were without the latest.
bool fitsTurning(const ViewGeometry& view, std::size_t sightings_before, const Sighting& latest,
                 const EstimatedPoint& point, const TrackOptions& options);

// Whether a track of many views has not moved in the picture while the table turned: part of the
// room, which could pass for a point of the axis. turned_rad: from its first view to its last.
bool standsStill(const Track& track, double turned_rad);

}  // namespace gyre
