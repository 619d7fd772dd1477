// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/place_wiring.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/scan_controller.h"
#include "core/track/usable_cylinder.h"
#include "ui/camera_view.h"
#include "ui/job_bar.h"
#include "ui/place_panel.h"
#include "ui/quick_look_card.h"
#include "ui/scene_view.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

// Where the object stays in the picture, and the drawing of it in the picture.
struct Usable {
  std::optional<UsableCylinder> cylinder;
  std::vector<PictureMark> drawn;
  bool shown = false;
};

Usable usableOf(const Calibration& calibration) {
  Usable usable;
  if (!calibration.cam_from_table) return usable;
  usable.cylinder = usableCylinder(calibration.camera, *calibration.cam_from_table);
  if (!usable.cylinder) return usable;
  for (const PictureLine& line :
       drawnInPicture(*usable.cylinder, calibration.camera, *calibration.cam_from_table)) {
    usable.drawn.push_back(
        {PictureMark::Shape::kLine, line.from.cast<float>(), line.to.cast<float>()});
  }
  return usable;
}

// Both views show it in this step alone: elsewhere it would be in the way.
void drawIn(WorkPage& page, Step step, Usable& usable) {
  const bool shows = step == Step::kPlace && usable.cylinder.has_value();
  page.scene_view->showUsable(shows ? usable.cylinder : std::nullopt);
  if (shows || usable.shown) {
    page.camera_view->setOverlay(shows ? usable.drawn : std::vector<PictureMark>());
  }
  usable.shown = shows;
}

}  // namespace

void wirePlace(WorkPage& page, ScanController& scans) {
  PlacePanel* panel = page.place_panel;
  QuickLookCard* card = panel->quick_look;
  QObject::connect(panel, &PlacePanel::emptyTableRequested, &scans,
                   &ScanController::takeEmptyTable);
  QObject::connect(&scans, &ScanController::emptyTableTaken, panel,
                   &PlacePanel::showEmptyTableTaken);
  QObject::connect(card, &QuickLookCard::lookRequested, &scans, &ScanController::quickLook);
  QObject::connect(card, &QuickLookCard::stopRequested, &scans, &ScanController::stop);
  QObject::connect(&scans, &ScanController::quickLookTaken, card, &QuickLookCard::showLook);
  QObject::connect(&scans, &ScanController::lookedAt, page.camera_view,
                   [&page](const FramePtr& frame) {
                     page.camera_view->showFrame(frame);
                     page.scene_view->showTableAngleRad(frame->table_angle_rad);
                   });
  auto phase = std::make_shared<ScanPhase>(ScanPhase::kIdle);
  QObject::connect(&scans, &ScanController::phaseChanged, page.job_bar,
                   [&page, phase](ScanPhase now) {
                     // The live picture goes on, so nothing else says that the work has ended.
                     if (std::exchange(*phase, now) == ScanPhase::kQuickLook) {
                       page.job_bar->showRest();
                     }
                   });
  QObject::connect(&scans.devices(), &DeviceSession::closed, panel, &PlacePanel::reset);
  auto usable = std::make_shared<Usable>();
  auto step = std::make_shared<Step>(Step::kConnect);
  QObject::connect(&scans, &ScanController::calibrationKnown, panel,
                   [&page, usable, step](const CalibrationRecord& record) {
                     const bool shown = usable->shown;
                     *usable = usableOf(record.calibration);
                     usable->shown = shown;
                     page.place_panel->showUsable(usable->cylinder);
                     drawIn(page, *step, *usable);
                   });
  QObject::connect(&page, &WorkPage::stepShown, panel, [&page, usable, step](Step shown) {
    *step = shown;
    drawIn(page, shown, *usable);
  });
}

}  // namespace gyre
