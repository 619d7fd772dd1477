// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibrated_rig.h"

#include <system_error>

#include "core/base/clock.h"
#include "core/io/picture_file.h"
#include "core/pipeline/check_before_scan.h"

namespace gyre {

Result<std::vector<std::string>> applyCalibration(const Rig& rig, const CalibrationRecord& record) {
  if (const auto same = sameCameraAsCalibrated(record, rig.camera->info()); !same) {
    return same.error();
  }
  std::vector<std::string> remarks;
  if (!record.turntable) return remarks;
  const CalibratedTurntable& known = *record.turntable;
  const TurntableInfo info = rig.turntable->info();
  if (known.device_id != info.device_id || known.axis != info.axis) {
    remarks.push_back("This turntable is not the one of the calibration (" + known.device_id +
                      ", axis " + known.axis + "): its steps per turn are taken from its board.");
    return remarks;
  }
  // What was told as one turn is so many units; the table needs so many others for one.
  const double turned_over_told =
      info.units_per_turn / known.units_per_turn * (info.direction == known.direction ? 1.0 : -1.0);
  if (turned_over_told == 1.0) return remarks;
  if (const auto done = rig.turntable->correct(turned_over_told); !done) return done.error();
  return remarks;
}

Result<std::string> lookBeforeScan(const Rig& rig, const std::filesystem::path& reference,
                                   const Task& task) {
  std::error_code ignored;
  if (!std::filesystem::exists(reference, ignored)) return std::string();
  const auto then = readPicture(reference);
  if (!then) return then.error();
  const auto now = rig.camera->grabAfter(steadySeconds(), task);
  if (!now) return now.error();
  const BeforeScanCheck check = checkByBackground(then->image_bgr, (*now)->image_bgr);
  return check.judged && !check.holds ? check.sentence : std::string();
}

}  // namespace gyre
