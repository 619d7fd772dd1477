// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibration_wiring.h"

#include <cmath>
#include <utility>
#include <vector>

#include "app/calibration_controller.h"
#include "app/scan_controller.h"
#include "ui/banner.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/place_page.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_wizard/target_page.h"
#include "ui/calibration_wizard/turn_page.h"
#include "ui/camera_view.h"
#include "ui/chime.h"
#include "ui/focus_panel.h"
#include "ui/scene_view.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

// Residuals are hundredths of a pixel: the usual one is drawn as long as this.
constexpr double kArrow_px = 40.0;

// How much they are enlarged: 1, 2 or 5 times a power of ten.
double arrowScale(double rms_px) {
  if (!(rms_px > 0.0)) return 1.0;
  const double wanted = kArrow_px / rms_px;
  const double ten = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / ten;
  return ten * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

std::vector<PictureMark> foundMarks(const TargetSight& sight) {
  std::vector<PictureMark> marks;
  marks.reserve(sight.found_px.size());
  for (const Eigen::Vector2f& pixel : sight.found_px) {
    marks.push_back({PictureMark::Shape::kCircle, pixel, pixel});
  }
  return marks;
}

std::vector<PictureMark> residualMarks(const CalibrationReport& report, double scale) {
  std::vector<PictureMark> marks;
  marks.reserve(report.residuals.size());
  for (const CalibrationResidual& residual : report.residuals) {
    const Eigen::Vector2f at = residual.pixel.cast<float>();
    const Eigen::Vector2f to = at + (scale * residual.residual_px).cast<float>();
    marks.push_back(
        {residual.used ? PictureMark::Shape::kArrow : PictureMark::Shape::kCross, at, to});
  }
  return marks;
}

void wireWishes(WorkPage& page, CalibrationController& calibrations, ScanController& scans) {
  CalibrationWizard& wizard = *page.calibration_panel->wizard;
  using Controller = CalibrationController;
  QObject::connect(page.calibration_panel, &CalibrationPanel::wizardShown, &calibrations,
                   [&page, &calibrations, &wizard](bool shown) {
                     page.camera_view->setOverlay({});
                     if (shown) {
                       calibrations.watch(wizard.step());
                     } else {
                       calibrations.stopWatching();
                     }
                   });
  QObject::connect(&wizard, &CalibrationWizard::stepShown, &calibrations,
                   [&page, &calibrations](WizardStep step) {
                     if (step != WizardStep::kResult) page.camera_view->setOverlay({});
                     if (step == WizardStep::kPlace) sound(Chime::kPlace);
                     calibrations.watch(step);
                   });
  QObject::connect(page.focus_panel, &FocusPanel::lockRequested, &scans.devices(),
                   &DeviceSession::lockCamera);
  QObject::connect(page.focus_panel, &FocusPanel::modeChosen, &scans.devices(),
                   &DeviceSession::reopenInMode);
  QObject::connect(page.focus_panel, &FocusPanel::goOnRequested, &page,
                   [&page] { page.showStep(Step::kCalibrate); });
  QObject::connect(&page, &WorkPage::stepShown, &calibrations, [&calibrations](Step step) {
    if (step == Step::kFocus) {
      calibrations.watchFocus();
    } else {
      calibrations.stopWatchingFocus();
    }
  });
  QObject::connect(wizard.target_page, &TargetPage::targetChosen, &calibrations,
                   &Controller::chooseTarget);
  QObject::connect(wizard.target_page, &TargetPage::printRequested, &calibrations,
                   &Controller::print);
  QObject::connect(wizard.place_page, &PlaceTargetPage::handRequested, &calibrations,
                   &Controller::beginHand);
  QObject::connect(wizard.place_page, &PlaceTargetPage::handCancelled, &calibrations,
                   &Controller::cancelHand);
  QObject::connect(page.camera_view, &CameraView::picked, &calibrations, &Controller::pick);
  QObject::connect(&scans, &ScanController::calibrationKnown, &calibrations,
                   [&calibrations, &wizard](const CalibrationRecord& record) {
                     calibrations.knowLens(record.calibration.camera);
                     wizard.target_page->allowKeepingLens();
                   });
  QObject::connect(wizard.turn_page, &TurnPage::startRequested, &calibrations,
                   [&wizard, &calibrations] {
                     wizard.turn_page->showRunning(0.0, TurnPage::tr("Beginning"));
                     calibrations.turn();
                   });
  QObject::connect(wizard.turn_page, &TurnPage::stopRequested, &calibrations, &Controller::stop);
  QObject::connect(wizard.result_page, &ResultPage::saveRequested, &calibrations,
                   [&calibrations](const QString& path) { calibrations.save(path.toStdString()); });
  QObject::connect(wizard.result_page, &ResultPage::againRequested, &wizard,
                   [&wizard] { wizard.showStep(WizardStep::kPlace); });
}

void wireFacts(WorkPage& page, CalibrationController& calibrations) {
  CalibrationWizard& wizard = *page.calibration_panel->wizard;
  using Controller = CalibrationController;
  QObject::connect(&calibrations, &Controller::targetsOffered, wizard.target_page,
                   &TargetPage::showOffers);
  QObject::connect(&calibrations, &Controller::targetReady, wizard.target_page,
                   &TargetPage::showReady);
  QObject::connect(&calibrations, &Controller::targetReady, wizard.place_page,
                   [&wizard](const TargetSketch& sketch) {
                     wizard.place_page->reset();
                     wizard.place_page->showSketch(sketch);
                   });
  QObject::connect(&calibrations, &Controller::cornerAsked, wizard.place_page,
                   &PlaceTargetPage::showAsked);
  QObject::connect(
      &calibrations, &Controller::cornerAsked, page.camera_view,
      [&page](std::optional<int> corner) { page.camera_view->setPicking(corner.has_value()); });
  QObject::connect(&calibrations, &Controller::picksChanged, page.camera_view,
                   [&page](const std::vector<Eigen::Vector2d>& pixels) {
                     TargetSight picks;
                     for (const auto& pixel : pixels) picks.found_px.push_back(pixel.cast<float>());
                     page.camera_view->setOverlay(foundMarks(picks));
                   });
  QObject::connect(&calibrations, &Controller::targetRefused, wizard.target_page,
                   &TargetPage::showProblem);
  QObject::connect(&calibrations, &Controller::printed, wizard.target_page,
                   &TargetPage::showPrinted);
  QObject::connect(&calibrations, &Controller::focusSeen, page.focus_panel, &FocusPanel::showFocus);
  QObject::connect(&calibrations, &Controller::sightSeen, wizard.place_page,
                   &PlaceTargetPage::showSight);
  QObject::connect(
      &calibrations, &Controller::sightSeen, page.camera_view,
      [&page](const TargetSight& sight) { page.camera_view->setOverlay(foundMarks(sight)); });
  QObject::connect(&calibrations, &Controller::pictureTaken, page.camera_view,
                   [&page](const FramePtr& frame, const TargetSight& sight) {
                     page.camera_view->setOverlay(foundMarks(sight));
                     page.camera_view->showFrame(frame);
                     page.scene_view->showTableAngleRad(frame->table_angle_rad);
                   });
  QObject::connect(&calibrations, &Controller::stopped, wizard.turn_page, &TurnPage::showStopped);
  QObject::connect(&calibrations, &Controller::turnFailed, wizard.turn_page,
                   &TurnPage::showFailure);
  QObject::connect(&calibrations, &Controller::failed, page.banner, &Banner::showError);
  QObject::connect(&calibrations, &Controller::measured, page.scene_view,
                   [&page, &wizard](const CalibrationOutcomePtr& outcome) {
                     const RigCalibration& rig = outcome->rig;
                     page.scene_view->showCalibration(rig.calibration);
                     page.scene_view->showTarget(rig.target, rig.table_from_target);
                     page.scene_view->fitRig();
                     wizard.turn_page->showDone();
                     const double scale = arrowScale(rig.report.rms_px);
                     wizard.result_page->showReport(rig.report, scale);
                     wizard.showStep(WizardStep::kResult);
                     page.camera_view->setOverlay(residualMarks(rig.report, scale));
                     sound(Chime::kDone);
                   });
}

}  // namespace

void wireCalibration(WorkPage& page, CalibrationController& calibrations, ScanController& scans) {
  wireWishes(page, calibrations, scans);
  wireFacts(page, calibrations);
  DeviceSession& devices = scans.devices();
  CalibrationPanel* panel = page.calibration_panel;
  QObject::connect(&devices, &DeviceSession::frameArrived, &calibrations,
                   &CalibrationController::lookAt);
  QObject::connect(&devices, &DeviceSession::cameraTold, page.focus_panel, &FocusPanel::showLocks);
  QObject::connect(&devices, &DeviceSession::cameraTold, panel, &CalibrationPanel::allowMeasuring);
  QObject::connect(&devices, &DeviceSession::progressed, panel->wizard->turn_page,
                   [&calibrations, panel](double fraction, const QString& stage) {
                     if (calibrations.turning()) {
                       panel->wizard->turn_page->showRunning(fraction, stage);
                     }
                   });
  QObject::connect(&devices, &DeviceSession::opened, panel,
                   [&page, &calibrations, panel](const TurntableInfo&, const CameraInfo& camera) {
                     page.focus_panel->showCamera(camera);
                     if (page.shownStep() == Step::kFocus) calibrations.watchFocus();
                     panel->forbidMeasuring(
                         CalibrationPanel::tr("Frame, focus and lock the camera first (step 2)."));
                   });
  QObject::connect(&devices, &DeviceSession::closed, panel, [panel] {
    panel->showOverview();
    panel->forbidMeasuring(CalibrationPanel::tr("Connect turntable and camera first (step 1)."));
  });
  calibrations.offerTargets();
}

}  // namespace gyre
