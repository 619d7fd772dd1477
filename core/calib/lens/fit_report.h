// Says how well a camera fits its sightings, in the fields of a calibration's report.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/calib/lens/refine_camera.h"
#include "core/scan/calibration_report.h"

namespace gyre {

// Fills rms, median, worst, sightings and outliers from the residuals, of which only used ones
// count. No residuals leave zeros.
void summarizeResiduals(CalibrationReport& report);

// Fills the standard deviations of focal length and principal point, the larger of both directions.
void reportSigmas(const CameraCovariance& covariance, CalibrationReport& report);

}  // namespace gyre
