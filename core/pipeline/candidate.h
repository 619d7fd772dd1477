// A point on its way into the cloud.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/pipeline/options.h"
#include "core/recover/point_estimator.h"
#include "core/scan/point_cloud.h"
#include "core/track/feature_tracker.h"

namespace gyre {

struct Candidate {
  std::uint32_t seed = 0;                 // of the estimator's chance, the same in every run
  Rgb rgb{};                              // of the surface there
  std::vector<Observation> observations;  // what the point is estimated from
  std::vector<Sighting> sightings;        // the same, undistorted
  std::optional<Sighting> returned;       // in the first view, of a track of the last one
  std::optional<Eigen::Vector3d> roughly_in_table;  // mm, before it is estimated
  std::optional<EstimatedPoint> estimated;

  static Candidate ofTrack(const MeasuredTrack& track, const std::optional<Sighting>& returned);
  // Replaces what was seen of it.
  void setObservations(const CameraModel& camera, std::vector<Observation> seen);
};

// The middle colour of all sightings, each channel by itself: a highlight in some does no harm.
Rgb middleColour(std::span<const Rgb> colours);

// The point is good enough to be judged by all masks.
bool plausible(const EstimatedPoint& estimated, const ReconstructOptions& options);

// The point as the cloud holds it, with the views that agree on it; one sighting an agreement.
Point pointOf(const Rgb& rgb, std::span<const Sighting> sightings, const EstimatedPoint& estimated);

// What a pixel shows of a surface that faces the camera, at the cloud's middle depth. [mm]
double mmAPixel(const CameraModel& camera, const Rigid3& cam_from_table, const PointCloud& cloud);

}  // namespace gyre
