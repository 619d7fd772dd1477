// What people are told of a calibration: the verdict, what to change, and what was noticed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/calib/rig/calibration_check.h"
#include "core/calib/rig/rig_bundle.h"
#include "core/scan/calibration_report.h"

namespace gyre {

// What the pictures were like: what could be changed to make the calibration better.
struct CaptureFacts {
  double arc_rad = 0.0;        // that the pictures cover
  double target_share = 0.0;   // of the picture's shorter side that the target fills, median
  double outlier_share = 0.0;  // of all sightings
};

// Sets verdict and sentence from the predicted errors and the facts; everything else is filled in.
void judge(const RigBundleOptions& options, const CaptureFacts& facts, CalibrationReport& report);

// Adds what the points that were held out came out as. Where they are measured worse than a verdict
// allows, it falls, and the sentence says so.
void judgeByCheck(const CalibrationCheck& check, const RigBundleOptions& options,
                  CalibrationReport& report);

// The sentences about motor and faces, from what the report has found.
std::vector<std::string> remarksOn(const CalibrationReport& report, const CaptureFacts& facts);

}  // namespace gyre
