// What a reconstruction gives.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/scan/drift.h"
#include "core/scan/point_cloud.h"
#include "core/scan/silhouette.h"
#include "core/scan/track.h"
#include "core/scan/turning.h"
#include "core/track/turn_gap.h"

namespace gyre {

struct Reconstruction {
  PointCloud cloud;
  // Where each point was seen, as far as it agrees: for its views, one by one.
  std::vector<std::vector<Observation>> sightings;
  Silhouettes silhouettes;       // of the object, as far as views told
  std::size_t observations = 0;  // in the accepted points
  double rms_px = 0.0;           // reprojection error of the accepted observations
  double median_px = 0.0;
  // Mean distance of a point from its rays: what the paper calls calibration error. [mm]
  double ray_distance_mm = 0.0;
  std::optional<TurnGap> turn_gap;        // after a full turn only
  DriftReport drift;                      // whether camera or table were bumped
  std::optional<TurningReport> turning;   // how the table truly turned
  std::map<std::string, double> seconds;  // stage -> time spent
};

}  // namespace gyre
