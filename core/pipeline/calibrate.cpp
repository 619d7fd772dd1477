// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/calibrate.h"

#include <utility>

#include "core/io/frame_folder.h"
#include "core/pipeline/solve_and_check.h"

namespace gyre {

CalibrationRecord recordOf(const CalibrationOutcome& outcome, const std::string& date) {
  CalibrationRecord record = recordOf(outcome.rig);
  record.date = date;
  record.turntable = outcome.turntable;
  record.camera = outcome.camera;
  return record;
}

Result<CalibrationOutcome> calibrateFromPictures(const CalibrationPictures& pictures,
                                                 const SoughtTarget& target,
                                                 const CalibrateOptions& options,
                                                 const CalibrationWatcher& watcher,
                                                 const Task& task) {
  const auto size = commonSize(pictures.files);
  if (!size) return size.error();
  auto sighted = sightPictures(pictures, target, {TargetHeld::kByTable, options.bundle.min_views},
                               watcher, task.part(0.0, 0.8));
  if (!sighted) return sighted.error();
  RigBundleOptions bundle = options.bundle;
  bundle.image_width_px = size->width_px;
  bundle.image_height_px = size->height_px;
  auto outcome = solveAndCheck(sighted->views, target.target, bundle, task.part(0.8, 1.0));
  if (outcome) outcome->skipped = std::move(sighted->skipped);
  return outcome;
}

}  // namespace gyre
