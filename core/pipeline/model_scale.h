// Size and height of a model that the pictures do not tell.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration.h"

namespace gyre {

// A model of unknown size is given this length. [mm]
constexpr double kUnknownSize_mm = 100.0;

// How an object stands on the table, in any unit.
struct Placement {
  double length = 0.0;        // of the longest line from one side of the object to the other
  double lowest = 0.0;        // z of its lowest points, or of the platter
  bool platter_seen = false;  // the points show the platter as well: a thin, wide layer at the foot
};

// Of points on the object and perhaps on the platter. The two in a thousand that reach furthest do
// not count. Zeros for no points.
Placement placementOf(std::span<const Eigen::Vector3d> points_in_table);

// The same pictures, with the object so long; the platter at z = 0 where it was seen, otherwise the
// object's lowest points a little above the least height at which features are looked for.
// length_mm > 0; cam_from_table is set.
void scaleCalibration(Calibration& calibration, const Placement& placement, double length_mm);

// The same model, so long, and the calibration that fits it; the platter stays at z = 0. Gives by
// how much it grew. length_mm > 0; cam_from_table is set.
double scaleModel(Reconstruction& model, Calibration& calibration, double length_mm);

}  // namespace gyre
