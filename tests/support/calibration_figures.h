// The judged figures of a calibration, over seeds, against the rig's truth.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/calib/rig/rig_bundle.h"
#include "core/scan/calibration.h"

namespace gyre::test {

// How far one calibration is from the truth.
struct CalibrationMiss {
  double focal = 0.0;         // relative, the worse of both
  double principal_px = 0.0;  // the worse of both
  double tilt_rad = 0.0;      // of the axis; yaw and height left aside
  double angles_rad = 0.0;    // rms over the pictures
  double object_mm = 0.0;     // rms on an object of 80 mm that is scanned with it
  double predicted_mm = 0.0;  // what the calibration itself says of object_mm
};

// true_rad: where the table stood in each picture of the calibration; the first is 0.
CalibrationMiss missOf(const RigCalibration& found, const Calibration& truth,
                       const std::vector<double>& true_rad);

// What the calibration does to a ball of 80 mm whose exact pixels are intersected with it: rms
// distance over its surface, after the best similarity. [mm]
double objectErrorMm(const Calibration& found, const Calibration& truth);

double rmsOf(const std::vector<double>& values);
double medianOf(std::vector<double> values);

// Prints the figures of all seeds and holds them against the limits: rms over the seeds of 0.05 %
// of the focal length, 1 px, 0.02 deg of tilt and of the angles; no seed over 2.5 times that; the
// median error of the object 0.01 mm.
void judgeFigures(const std::string& name, const std::vector<CalibrationMiss>& seeds);

}  // namespace gyre::test
