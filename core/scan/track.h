// The sightings of one physical point.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Where one view saw the point.
struct Observation {
  std::int32_t view = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // raw (distorted) picture coordinates
  double sigma_px = 0.2;                            // standard deviation of either coordinate
};

struct Track {
  std::uint32_t id = 0;                   // unique within a scan, in the order of detection
  std::vector<Observation> observations;  // ascending views, at most one a view
};

}  // namespace gyre
