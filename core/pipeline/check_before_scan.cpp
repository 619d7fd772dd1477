// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/check_before_scan.h"

#include <cmath>

#include "core/base/formatted.h"
#include "core/calib/rig/calibration_check.h"
#include "core/track/drift_monitor.h"

namespace gyre {
namespace {

// Between two days the light differs, and shadows with it: less than this is no bump.
constexpr double kLeast_px = 0.4;
// Drivers count focus and zoom in steps of their own; read back they may be off by rounding.
constexpr double kSameSetting = 1e-3;

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

}  // namespace

BeforeScanCheck checkByBackground(const cv::Mat& reference_bgr, const cv::Mat& image_bgr) {
  DriftOptions options;
  options.least_px = kLeast_px;
  const ViewDrift drift = pictureDrift(reference_bgr, image_bgr, options);
  BeforeScanCheck check;
  check.judged = drift.judged;
  check.holds = drift.judged && !drift.moved;
  check.px = drift.px;
  if (!check.judged) {
    check.sentence =
        "Whether the camera still stands where it was calibrated cannot be told: too little around "
        "the table looks as it did.";
  } else if (check.holds) {
    check.sentence = "The camera stands where it was calibrated.";
  } else {
    check.sentence = "The camera has moved since it was calibrated: what stands still is " +
                     pxText(drift.px) + " off. Calibrate again, or put it back.";
  }
  return check;
}

BeforeScanCheck checkByTarget(const CalibrationRecord& record, const SoughtTarget& target,
                              const cv::Mat& image_bgr) {
  BeforeScanCheck check;
  check.sentence = "The picture does not show the target by which the rig was calibrated.";
  if (!record.table_from_target || !record.calibration.cam_from_table) return check;
  const auto view = target.find(image_bgr);
  if (!view) return check;
  RigCalibration known;
  known.calibration = record.calibration;
  known.table_from_target = *record.table_from_target;
  known.target = target.target;
  if (record.points_in_target.size() == pointsOf(target.target).size()) {
    known.target = withPoints(target.target, record.points_in_target);
  }
  const auto place = checkPlace(known, *view);
  if (!place) return check;
  check.judged = true;
  check.holds = place->fits;
  check.px = place->offset_px;
  check.sentence = place->sentence;
  return check;
}

CalibratedCamera calibratedCamera(const CameraInfo& camera) {
  CalibratedCamera calibrated;
  calibrated.device_id = camera.description;
  calibrated.mode = camera.mode.empty() ? sizeText(camera.width_px, camera.height_px) : camera.mode;
  for (const ControlState& control : camera.controls) {
    if (control.locked) calibrated.settings[control.name] = control.value;
  }
  return calibrated;
}

Result<void> sameCameraAsCalibrated(const CalibrationRecord& record, const CameraInfo& camera) {
  const CameraModel& model = record.calibration.camera;
  if (camera.width_px > 0 &&
      (camera.width_px != model.width_px || camera.height_px != model.height_px)) {
    return Error{Error::Code::kRejected,
                 "The camera gives pictures of " + sizeText(camera.width_px, camera.height_px) +
                     ", but it was calibrated at " + sizeText(model.width_px, model.height_px) +
                     ".",
                 "Choose the mode in which it was calibrated, or calibrate this one."};
  }
  if (!record.camera) return {};
  const CalibratedCamera now = calibratedCamera(camera);
  for (const char* lens : {"focus", "zoom"}) {
    const auto then = record.camera->settings.find(lens);
    const auto here = now.settings.find(lens);
    if (then == record.camera->settings.end() || here == now.settings.end()) continue;
    if (std::abs(then->second - here->second) <= kSameSetting) continue;
    return Error{Error::Code::kRejected,
                 std::string("The camera's ") + lens + " is not what it was when calibrated.",
                 "Set it back, or calibrate again: the calibration holds for one lens setting."};
  }
  return {};
}

}  // namespace gyre
