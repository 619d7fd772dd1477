// What the scan controller does with several passes of one object.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "app/merge_job.h"
#include "app/scan_controller.h"

namespace gyre {

void ScanController::turnOver() {
  if (!devices_.isOpen() || !devices_.rig()->room) return;
  devices_.runAlone([rig = devices_.rig()](const Task&) { return rig->room->turnOver(); },
                    [this](const Result<void>& outcome) {
                      if (!outcome) Q_EMIT failed(outcome.error());
                    });
}

void ScanController::merge(const std::vector<std::filesystem::path>& results) {
  if (isCapturing(phase_) || phase_ == ScanPhase::kFinishing || jobs_ > 0) {
    refuse(tr("Something else goes on."), tr("Wait for its end, or stop it, and merge then."));
    return;
  }
  beginComputing(ScanPhase::kMerging);
  for (const auto& result : results) {
    Q_EMIT logged(tr("Merge %1").arg(QString::fromStdString(result.string())));
  }
  auto merged = std::make_shared<MergedModel>();
  compute_jobs_.start(
      [results, merged](const Task& task) -> Result<void> {
        auto made = mergeResults(results, task);
        if (!made) return made.error();
        *merged = std::move(made).value();
        return {};
      },
      [this, merged](const Result<void>& outcome) {
        endComputing(outcome);
        if (outcome) {
          merged->model.calibration.reset();  // that of a pass, which is in use
          takeOpened(merged->model);
          if (merged->problem) Q_EMIT failed(*merged->problem);
        } else if (outcome.error().code != Error::Code::kCancelled) {
          Q_EMIT mergeRefused(outcome.error());
        }
        makeNextSurface();
      });
}

}  // namespace gyre
