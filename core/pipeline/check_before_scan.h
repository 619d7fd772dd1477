// Whether a saved calibration still holds, by one picture before a scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/pipeline/calibrate.h"
#include "core/scan/calibration_record.h"
#include "core/scan/device_info.h"
#include "core/scan/frame.h"

namespace gyre {

struct BeforeScanCheck {
  bool judged = false;  // the picture tells something
  bool holds = false;   // camera and table are where they were
  double px = 0.0;      // how far what stands still is off
  std::string sentence;
};

// By what stands still around the table: the picture against the one that was taken while the rig
// was calibrated, whatever stands on the table now. Not judged when too little stands still.
BeforeScanCheck checkByBackground(const cv::Mat& reference_bgr, const cv::Mat& image_bgr);

// By a target that is fixed to the platter where it was calibrated, such as a ring of markers: what
// the picture shows of it against where the calibration puts it. Not judged when it is not seen, or
// when the record does not say where it stood.
BeforeScanCheck checkByTarget(const CalibrationRecord& record, const SoughtTarget& target,
                              const cv::Mat& image_bgr);

// Fails, with the reason, when the camera is not set as it was calibrated: another picture size,
// focus or zoom. What the camera does not tell is passed over.
Result<void> sameCameraAsCalibrated(const CalibrationRecord& record, const CameraInfo& camera);

// How the camera is set, as the record keeps it.
CalibratedCamera calibratedCamera(const CameraInfo& camera);

}  // namespace gyre
