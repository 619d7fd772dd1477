// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibrated_rig.h"

#include <optional>
#include <system_error>
#include <utility>

#include "core/base/clock.h"
#include "core/io/picture_file.h"
#include "core/pipeline/check_before_scan.h"
#include "core/pipeline/measured_turntable.h"
#include "core/pipeline/platter_ring.h"
#include "core/pipeline/target_finder.h"

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
  if (const auto done = matchTurning(rig, known.units_per_turn, known.direction); !done) {
    return done.error();
  }
  takeUpBacklash(*rig.turntable, known.backlash_rad);
  return remarks;
}

Result<void> matchTurning(const Rig& rig, double units_per_turn, int direction) {
  const TurntableInfo info = rig.turntable->info();
  // What was told as one turn is so many units; the table needs so many others for one.
  const double turned_over_told =
      info.units_per_turn / units_per_turn * (info.direction == direction ? 1.0 : -1.0);
  if (turned_over_told == 1.0) return {};
  return rig.turntable->correct(turned_over_told);
}

Result<std::string> lookBeforeScan(const Rig& rig, const CalibrationRecord& record,
                                   const std::filesystem::path& reference, const Task& task) {
  std::error_code ignored;
  const bool has_reference = std::filesystem::exists(reference, ignored);
  const std::optional<Target> ring = ringOf(record);
  if (!ring && !has_reference) return std::string();
  const auto now = rig.camera->grabAfter(steadySeconds(), task);
  if (!now) return now.error();
  BeforeScanCheck check;
  if (ring) check = checkByTarget(record, soughtTarget(*ring), (*now)->image_bgr);
  if (!check.judged && has_reference) {
    const auto then = readPicture(reference);
    if (!then) return then.error();
    check = checkByBackground(then->image_bgr, (*now)->image_bgr);
  }
  return check.judged && !check.holds ? check.sentence : std::string();
}

Result<std::vector<std::string>> prepareRig(const Rig& rig, const CalibrationRecord& record,
                                            const std::filesystem::path& reference,
                                            const Task& task) {
  auto remarks = applyCalibration(rig, record);
  if (!remarks) return remarks;
  auto moved = lookBeforeScan(rig, record, reference, task);
  if (!moved) return moved.error();
  if (!moved->empty()) remarks->push_back(std::move(*moved));
  return remarks;
}

}  // namespace gyre
