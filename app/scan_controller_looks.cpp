// What the scan controller looks at before a scan: the empty table, and the object from all sides.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibrated_rig.h"
#include "app/count_anew.h"
#include "app/scan_controller.h"
#include "core/pipeline/quick_look.h"

namespace gyre {
namespace {

constexpr double kTurningShare = 0.9;  // of the time that a quick look takes

// The picture of the empty table with the angle that its place has now; null when that is lost.
FramePtr emptyTableNow(const std::optional<EmptyTable>& empty_table, const Turntable& turntable) {
  if (!empty_table) return nullptr;
  const auto angle_rad = turntable.angleAt(empty_table->place);
  if (!angle_rad) return nullptr;
  Frame frame = *empty_table->picture;
  frame.table_angle_rad = *angle_rad;
  return std::make_shared<const Frame>(std::move(frame));
}

}  // namespace

void ScanController::takeEmptyTable() {
  if (!devices_.isOpen() || isCapturing(phase_) || phase_ == ScanPhase::kQuickLook) return;
  const ScanPhase before = phase_;
  setPhase(ScanPhase::kEmptyTable);
  auto picture = std::make_shared<EmptyTable>();
  devices_.runAlone(
      [rig = devices_.rig(), picture](const Task& task) -> Result<void> {
        if (const auto counted = countAnewIfLost(*rig->turntable); !counted) return counted;
        auto taken = pictureOfEmptyTable(*rig, task);
        if (!taken) return taken.error();
        *picture = std::move(taken).value();
        return {};
      },
      [this, before, picture](const Result<void>& outcome) {
        setPhase(before);
        if (!outcome) {
          if (outcome.error().code != Error::Code::kCancelled) Q_EMIT failed(outcome.error());
          return;
        }
        empty_table_ = *picture;
        Q_EMIT emptyTableTaken();
      });
}

void ScanController::quickLook() {
  if (!readyToScan()) return;
  const ScanPhase before = phase_;
  setPhase(ScanPhase::kQuickLook);
  Q_EMIT quickLookTaken(nullptr);
  const auto show = [this](const FramePtr& frame) {
    QMetaObject::invokeMethod(
        this, [this, frame] { Q_EMIT lookedAt(frame); }, Qt::QueuedConnection);
  };
  auto look = std::make_shared<QuickLook>();
  devices_.runAlone(
      [rig = devices_.rig(), record = *calibration_, empty_table = empty_table_, show,
       look](const Task& task) -> Result<void> {
        const auto applied = applyCalibration(*rig, record);
        if (!applied) return applied.error();
        if (const auto counted = countAnewIfLost(*rig->turntable); !counted) return counted;
        if (rig->room) rig->room->setTable(TableLoad::kObject);
        const auto pictures =
            takeQuickLook(*rig->turntable, *rig->camera, show, task.part(0.0, kTurningShare));
        if (!pictures) return pictures.error();
        auto judged =
            judgeQuickLook(record.calibration, emptyTableNow(empty_table, *rig->turntable),
                           *pictures, task.part(kTurningShare, 1.0));
        if (!judged) return judged.error();
        *look = std::move(judged).value();
        return {};
      },
      [this, before, look](const Result<void>& outcome) {
        setPhase(before);
        if (outcome) {
          Q_EMIT quickLookTaken(look);
        } else if (outcome.error().code != Error::Code::kCancelled) {
          Q_EMIT failed(outcome.error());
        }
      });
}

}  // namespace gyre
