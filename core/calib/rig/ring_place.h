// Where points that are fixed to the platter show that the table stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/scan/calibration.h"
#include "core/scan/target_view.h"

namespace gyre {

struct RingPlace {
  double angle_rad = 0.0;  // of the table, turned about its axis alone; in (-pi, pi]
  double sigma_rad = 0.0;  // one standard deviation of that
  // How far the points lie off where turning alone puts them, if they moved as one rigid thing: rms
  // over the sightings. What remains then is noise, and no part of it.
  double px = 0.0;
  double sigma_px = 0.0;      // what noise alone would make of that
  std::size_t sightings = 0;  // that agree with each other
};

// points_in_table: where the calibration has each point of the target, in the order of
// pointsOf(target). [mm] The calibration must know the camera's place. Nothing when fewer than 8
// sightings agree: those of two markers.
//
// The angle by Gauss and Newton from the sightings' azimuths on the platter, sightings beyond six
// times their median left out; then one step with all six freedoms of a rigid motion, of which the
// part that turning could explain is taken away.
std::optional<RingPlace> placeOfRing(const Calibration& calibration,
                                     std::span<const Eigen::Vector3d> points_in_table,
                                     const TargetView& view);

}  // namespace gyre
