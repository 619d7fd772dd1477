// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/solve_and_check.h"

#include <utility>

#include "core/calib/rig/calibration_check.h"
#include "core/calib/rig/rig_verdict.h"

namespace gyre {
namespace {

constexpr int kHeldOut = 5;  // one point of so many

// Nothing when too little is left, with or without the points: that says nothing against the rig.
std::optional<CalibrationCheck> checkByHeldOut(const std::vector<TargetView>& views,
                                               const Target& target,
                                               const RigBundleOptions& options, const Task& task) {
  // Markers that may lie anywhere have no places that could be measured wrong.
  if (options.shape == TargetShape::kLooseMarkers) return std::nullopt;
  const auto [kept, held] = holdOut(views, kHeldOut);
  const auto rig = calibrateRig(kept, target, options, task);
  if (!rig) return std::nullopt;
  // The target as it turned out to be: its held-out points lie on the faces as they are bent.
  auto check = checkCalibration(rig->calibration, held, rig->target, task);
  if (!check) return std::nullopt;
  return std::move(*check);
}

}  // namespace

Result<CalibrationOutcome> solveAndCheck(const std::vector<TargetView>& views, const Target& target,
                                         const RigBundleOptions& options, const Task& task) {
  task.report(0.0, "Solving camera, axis and angles");
  auto rig = calibrateRig(views, target, options, task);
  if (!rig) return rig.error();
  CalibrationOutcome outcome;
  outcome.rig = std::move(*rig);
  outcome.views = views;
  task.report(0.6, "Checking by points that were held out");
  if (const auto check = checkByHeldOut(views, target, options, task)) {
    judgeByCheck(*check, options, outcome.rig.report);
  }
  if (task.stopRequested()) return cancelled();
  return outcome;
}

}  // namespace gyre
