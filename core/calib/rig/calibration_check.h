// Whether a calibration holds: against a second target, and against the same rig another day.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/rig/rig_bundle.h"

namespace gyre {

// What a target measures when it is scanned like an object.
struct CalibrationCheck {
  std::size_t points = 0;   // that were measured
  double rms_px = 0.0;      // of all sightings
  double error_mm = 0.0;    // rms distance of the points from where the target has them, fitted
                            // rigidly: without scale
  double detail_mm = 0.0;   // the same fitted with scale
  double size_share = 0.0;  // measured size over the target's, less one
  std::string sentence;
};

// Measures the points of the views by the calibration alone, its intrinsics and axis held, and
// compares them with the target. The target may be another one than it was calibrated with, or the
// same with corners that were held out. Needs a calibration with a table.
//
// Fails when fewer than 6 points can be measured or when the target does not fit the pictures.
Result<CalibrationCheck> checkCalibration(const Calibration& calibration,
                                          std::span<const TargetView> views, const Target& target,
                                          const Task& task);

// Splits the sightings by point: every nth point of the target is held out of the first and makes
// the second. n >= 2.
std::pair<std::vector<TargetView>, std::vector<TargetView>> holdOut(
    std::span<const TargetView> views, int every_nth);

// How far one picture of a target that is fixed to the platter is from where it should be.
struct PlaceCheck {
  bool fits = false;       // within max_offset_px
  double offset_px = 0.0;  // rms of the sightings, the table turned to fit best
  double offset_mm = 0.0;  // the same at the target's distance
  double angle_rad = 0.0;  // of the table, as the picture shows it
  std::string sentence;
};

struct PlaceCheckOptions {
  // More than this off, and camera or table were moved. [px], > 0
  double max_offset_px = 0.5;
};

// Looks at one picture of the very target, in the very place, that the calibration was made with.
// Fails with fewer than 4 sightings.
Result<PlaceCheck> checkPlace(const RigCalibration& known, const TargetView& view,
                              const PlaceCheckOptions& options = {});

}  // namespace gyre
