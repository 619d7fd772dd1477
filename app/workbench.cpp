// Wires the window's wishes to the scan controller, and its facts to the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/workbench.h"

#include <QApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QTimer>
#include <QUrl>

#include "app/calibration_wiring.h"
#include "app/passes_wiring.h"
#include "app/place_wiring.h"
#include "app/surface_wiring.h"
#include "core/device/discovery.h"
#include "core/scan/point_cloud.h"
#include "ui/banner.h"
#include "ui/calibration_panel.h"
#include "ui/camera_view.h"
#include "ui/chime.h"
#include "ui/device_panel.h"
#include "ui/export_panel.h"
#include "ui/job_bar.h"
#include "ui/log_panel.h"
#include "ui/mesh_panel.h"
#include "ui/passes_card.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/scene_view.h"
#include "ui/start_page.h"
#include "ui/step_list.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

struct Listed {
  std::vector<PortInfo> ports;
  std::vector<CameraDeviceInfo> cameras;
};

std::filesystem::path pathOf(const QString& path) { return path.toStdString(); }

QString devicesSentence(const Listed& listed) {
  return Workbench::tr("Connected now: %n serial port(s), ", nullptr,
                       static_cast<int>(listed.ports.size())) +
         Workbench::tr("%n camera(s).", nullptr, static_cast<int>(listed.cameras.size()));
}

}  // namespace

Workbench::Workbench(const RigOptions& rig)
    : controller_(withPerson(rig, person_)),
      calibrations_(controller_.devices()),
      small_jobs_("gyre-small") {
  wireStart();
  wireDevices();
  wireDoctor();
  wirePerson();
  wireScan();
  wireResults();
  wirePlace(*window_.work_page, controller_);
  wireSurface(*window_.work_page, controller_, measures_);
  wirePasses(window_, controller_);
  wireFacts();
  wireCalibration(*window_.work_page, calibrations_, controller_);
  wireKeeping();
  listDevices();
  showSteps();
}

void Workbench::wireStart() {
  StartPage* page = window_.start_page;
  connect(page, &StartPage::demoRequested, this,
          [this] { runDemo("duck", 72, settings_.newScanFolder(tr("Duck"))); });
  connect(page, &StartPage::shown, this, [this, page] {
    page->showRecent(settings_.recentScans());
    showLastCalibration();
  });
  connect(&window_, &MainWindow::newScanRequested, this, &Workbench::newScan);
  connect(&window_, &MainWindow::openRequested, this, &Workbench::open);
  connect(&window_, &MainWindow::themeChosen, this, [this](ThemeChoice choice) {
    settings_.setTheme(choice);
    applyTheme(*qApp, choice);
  });
  connect(&window_, &MainWindow::closeRequested, this, [this] {
    if (isCapturing(controller_.phase())) {
      window_.work_page->banner->showNotice(tr("Stopping the table before closing…"), QString());
    }
    controller_.shutDown();
  });
  connect(&controller_, &ScanController::quiet, this, [this] {
    quiet_ = true;
    closeWhenQuiet();
  });
  connect(&measures_, &MeasureController::idle, this, &Workbench::closeWhenQuiet);
}

// What was measured last is on the disk before the window goes.
void Workbench::closeWhenQuiet() {
  if (!quiet_ || measures_.busy() || doctor_.busy()) return;
  window_.allowClose();
  window_.close();
}

void Workbench::wireDevices() {
  DevicePanel* panel = window_.work_page->device_panel;
  DeviceSession* devices = &controller_.devices();
  connect(panel, &DevicePanel::refreshRequested, this, &Workbench::listDevices);
  connect(panel, &DevicePanel::connectRequested, this,
          [this, devices](const QString& turntable, const QString& camera) {
            window_.work_page->banner->dismiss();
            settings_.setDevices(turntable, camera);
            devices->open(turntable, camera);
          });
  connect(panel, &DevicePanel::disconnectRequested, devices, &DeviceSession::close);
  connect(panel, &DevicePanel::turnRequestedDeg, devices, &DeviceSession::turnByDeg);
  connect(panel, &DevicePanel::angleRequestedDeg, devices, &DeviceSession::turnToDeg);
  connect(panel, &DevicePanel::releaseRequested, devices, &DeviceSession::releaseMotor);
  connect(panel, &DevicePanel::turntableConfirmed, this, [this, devices] {
    settings_.rememberTurntable(device_id_);
    devices->confirmTurntable();
    showSteps();
  });
  connect(panel, &DevicePanel::unlockAllowed, devices, &DeviceSession::allowUnlock);
  connect(devices, &DeviceSession::lockTold, panel, &DevicePanel::askToUnlock);
  connect(&calibrations_, &CalibrationController::turnFailed, this, &Workbench::askWhenLocked);
  connect(devices, &DeviceSession::opened, this, &Workbench::devicesOpened);
  connect(devices, &DeviceSession::openFailed, this, [this] {
    demo_ = false;
    window_.showPhase(controller_.phase());
  });
  connect(devices, &DeviceSession::angleKnownDeg, panel, &DevicePanel::showAngleDeg);
  connect(devices, &DeviceSession::opening, this,
          [this] { window_.showPhase(ScanPhase::kConnecting); });
  connect(devices, &DeviceSession::cameraTold, panel, &DevicePanel::showCamera);
  connect(devices, &DeviceSession::cameraTold, this, [this] {
    locked_ = true;
    showSteps();
  });
  connect(devices, &DeviceSession::frameArrived, window_.work_page->camera_view,
          &CameraView::showFrame);
  connect(devices, &DeviceSession::closed, this, [this] {
    window_.work_page->camera_view->clear(tr("No camera yet"));
    placed_ = false;
    locked_ = false;
  });
}

void Workbench::wireScan() {
  WorkPage* page = window_.work_page;
  connect(page->calibration_panel, &CalibrationPanel::fileChosen, this, &Workbench::useCalibration);
  connect(page->place_panel, &PlacePanel::objectPlaced, this, [this] {
    placed_ = true;
    showSteps();
    window_.showWork(Step::kScan);
  });
  connect(page->scan_panel, &ScanPanel::startRequested, this, &Workbench::startScan);
  connect(page->scan_panel, &ScanPanel::folderChanged, this, &Workbench::showCost);
  connect(page->scan_panel, &ScanPanel::resumeRequested, &controller_, &ScanController::resumeScan);
  connect(page->scan_panel, &ScanPanel::trustGiven, &controller_, &ScanController::resumeTrusting);
  connect(&controller_, &ScanController::objected, this, [this, page](const Error& objection) {
    window_.showWork(Step::kScan);
    page->scan_panel->askTrust(objection);
    window_.log_panel->addLine(QString::fromStdString(objection.sentence()));
  });
  connect(page->job_bar, &JobBar::startRequested, this, &Workbench::startScan);
  connect(&window_, &MainWindow::pauseRequested, &controller_, &ScanController::pause);
  connect(&window_, &MainWindow::resumeRequested, &controller_, &ScanController::resume);
  connect(&window_, &MainWindow::stopRequested, &controller_, &ScanController::stop);
  connect(&controller_, &ScanController::emptyTableTaken, this, [this] {
    showSteps();
    if (demo_) {
      demo_ = false;
      placed_ = true;
      startScan();
    }
  });
}

void Workbench::wireResults() {
  WorkPage* page = window_.work_page;
  connect(page->export_panel, &ExportPanel::pointsExportRequested, &controller_,
          [this](const QString& path) { controller_.exportPoints(pathOf(path)); });
  connect(page->export_panel, &ExportPanel::meshExportRequested, &controller_,
          [this](const QString& path) { controller_.exportMesh(pathOf(path)); });
  connect(&controller_, &ScanController::written, page->export_panel, &ExportPanel::showWritten);
  connect(page->mesh_panel->passes, &PassesCard::turnOverRequested, this, [this] {
    placed_ = false;
    showSteps();
  });
  connect(page->export_panel, &ExportPanel::openRequested, this, [page](const QString& path) {
    if (QDesktopServices::openUrl(QUrl::fromLocalFile(path))) return;
    page->banner->showNotice(tr("This computer has no program for \"%1\".").arg(path),
                             tr("Install a slicer or a viewer, or open the file from there."));
  });
  connect(&controller_, &ScanController::meshMade, this, [this] {
    window_.showWork(Step::kMesh);
    showSteps();
    QTimer::singleShot(200, this, &Workbench::rememberScan);  // after it is on the screen
  });
}

void Workbench::wireFacts() {
  WorkPage* page = window_.work_page;
  connect(&controller_, &ScanController::phaseChanged, this, [this](ScanPhase phase) {
    window_.showPhase(phase);
    window_.log_panel->addLine(phaseText(phase));
    if (phase == ScanPhase::kPaused) sound(Chime::kPaused);
    if (phase == ScanPhase::kDone) sound(Chime::kDone);
    showSteps();
  });
  connect(&controller_, &ScanController::tracked, this, [page](const TrackedFramePtr& tracked) {
    page->camera_view->showTrackedFrame(tracked);
    page->scene_view->showTableAngleRad(tracked->frame->table_angle_rad);
  });
  connect(&controller_, &ScanController::cloudGrew, this, [this, page](const PointCloudPtr& cloud) {
    page->scene_view->showCloud(cloud);
    page->export_panel->showAvailable(
        cloud ? cloud->points.size() : 0,
        controller_.mesh() ? controller_.mesh()->triangles.size() : 0);
  });
  connect(&controller_, &ScanController::factsChanged, page->job_bar, &JobBar::showFacts);
  connect(&controller_, &ScanController::factsChanged, page->scan_panel, &ScanPanel::showFacts);
  connect(&controller_, &ScanController::progressed, this,
          [this](double fraction, const QString& stage) {
            if (!isCapturing(controller_.phase())) {
              window_.work_page->job_bar->showProgress(fraction, stage);
            }
          });
  connect(&controller_, &ScanController::rested, page->job_bar, &JobBar::showRest);
  connect(&controller_, &ScanController::calibrationKnown, this,
          [this, page](const CalibrationRecord& record, const QString& source) {
            page->calibration_panel->showCalibration(record, source);
            page->scene_view->showCalibration(record.calibration);
            showSteps();
          });
  connect(&controller_, &ScanController::failed, this, [this](const Error& error) {
    askWhenLocked(error);
    window_.work_page->banner->showError(error);
    window_.log_panel->addLine(QString::fromStdString(error.sentence()));
  });
  connect(&controller_, &ScanController::noticed, page->banner, &Banner::showNotice);
  connect(&controller_, &ScanController::logged, window_.log_panel, &LogPanel::addLine);
}

void Workbench::listDevices() {
  auto listed = std::make_shared<Listed>();
  small_jobs_.start(
      [listed](const Task&) -> Result<void> {
        listed->ports = listPorts();
        listed->cameras = listCameras();
        return {};
      },
      [this, listed](const Result<void>&) {
        DevicePanel* panel = window_.work_page->device_panel;
        panel->showPorts(listed->ports);
        panel->showCameras(listed->cameras);
        panel->choose(settings_.turntable(), settings_.camera());
        window_.start_page->showDevices(devicesSentence(*listed));
      });
}

void Workbench::devicesOpened(const TurntableInfo& turntable, const CameraInfo& camera) {
  DevicePanel* panel = window_.work_page->device_panel;
  device_id_ = QString::fromStdString(turntable.device_id);
  panel->showTurntable(turntable);
  panel->askToUnlock(QString::fromStdString(turntable.lock));
  panel->showCamera(camera);
  DeviceSession& devices = controller_.devices();
  const QString kept = settings_.calibrationFor(device_id_, devices.cameraWord());
  if (!kept.isEmpty()) controller_.useCalibration(pathOf(kept));
  if (settings_.knowsTurntable(device_id_)) devices.confirmTurntable();
  if (devices.mayMove()) {
    panel->allowMoving();
  } else {
    panel->askWhetherTurntable();
  }
  picture_size_ = {camera.width_px, camera.height_px};
  // Where the scan would be kept, so that its disk is known before it is begun.
  ScanPanel* scan = window_.work_page->scan_panel;
  if (scan->folder().isEmpty()) scan->setFolder(settings_.newScanFolder(title_));
  steps_per_turn_ = turntable.steps_per_turn;
  showViewsRemark();
  if (devices.turnedByHand()) offerMarks(turntable.steps_per_turn);
  showCost();
  showSteps();
  if (demo_) controller_.takeEmptyTable();
}

// The question stands in step 1 until it is answered.
void Workbench::askWhenLocked(const Error& error) {
  if (error.code == Error::Code::kNoPermission) controller_.devices().tellLock();
}

void Workbench::newScan() {
  title_ = tr("Scan");
  listDevices();
  window_.showWork(Step::kConnect);
}

void Workbench::runDemo(const QString& object, int views, const QString& folder) {
  if (controller_.devices().isOpen() || controller_.phase() != ScanPhase::kIdle) {
    window_.showWork(Step::kConnect);
    window_.work_page->banner->showNotice(tr("Something is connected already."),
                                          tr("Disconnect it, then try the demo."));
    return;
  }
  demo_ = true;
  title_ = tr("Demo: %1").arg(object);
  window_.work_page->scan_panel->setViews(views);
  window_.work_page->scan_panel->setFolder(folder);
  window_.work_page->device_panel->choose("sim:" + object, "sim");
  window_.showWork(Step::kScan);
  controller_.devices().open("sim:" + object, "sim");
}

void Workbench::startScan() {
  ScanPanel* panel = window_.work_page->scan_panel;
  if (panel->folder().isEmpty() || QDir(panel->folder()).exists()) {
    panel->setFolder(settings_.newScanFolder(title_));
  }
  window_.work_page->banner->dismiss();
  window_.work_page->scene_view->showCloud(nullptr);
  window_.work_page->export_panel->setFolder(panel->folder());
  window_.showWork(Step::kScan);
  QDir().mkpath(QFileInfo(panel->folder()).absolutePath());
  controller_.startScan({panel->views(), pathOf(panel->folder()), title_});
}

void Workbench::open(const QString& path) {
  title_ = QFileInfo(path).completeBaseName();
  window_.work_page->banner->dismiss();
  window_.showWork(Step::kMesh);
  controller_.openModel(pathOf(path));
}

void Workbench::showSteps() {
  const ScanPhase phase = controller_.phase();
  const auto at = [](Step step) { return static_cast<std::size_t>(step); };
  StepStates states{};
  states.fill(StepState::kTodo);
  const bool open = controller_.devices().isOpen();
  const bool has_points = controller_.cloud() && !controller_.cloud()->points.empty();
  states[at(Step::kConnect)] = !open                             ? StepState::kNow
                               : controller_.devices().mayMove() ? StepState::kDone
                                                                 : StepState::kAttention;
  if (open) states[at(Step::kFocus)] = locked_ || placed_ ? StepState::kDone : StepState::kNow;
  if (controller_.calibration()) {
    states[at(Step::kCalibrate)] = controller_.calibration()->calibration.cam_from_table
                                       ? StepState::kDone
                                       : StepState::kAttention;
  } else if (locked_) {
    states[at(Step::kCalibrate)] = StepState::kNow;
  }
  if (placed_) states[at(Step::kPlace)] = StepState::kDone;
  if (isCapturing(phase) || phase == ScanPhase::kFinishing) {
    states[at(Step::kScan)] = StepState::kNow;
  } else if (phase == ScanPhase::kFailed) {
    states[at(Step::kScan)] = StepState::kAttention;
  } else if (has_points) {
    states[at(Step::kScan)] = StepState::kDone;
  }
  if (controller_.mesh()) {
    states[at(Step::kMesh)] = StepState::kDone;
    states[at(Step::kExport)] = StepState::kNow;
  }
  window_.work_page->steps->setStates(states);
}

void Workbench::rememberScan() {
  if (controller_.folder().empty() || !controller_.mesh()) return;
  RecentScan scan;
  scan.folder = QString::fromStdString(controller_.folder().string());
  scan.title = title_;
  scan.when = QDateTime::currentDateTime();
  scan.size_mm = boundsOf(*controller_.mesh()).diagonal();
  settings_.rememberScan(scan);
  const QString file = QDir(scan.folder).filePath("thumbnail.png");
  small_jobs_.start(
      [picture = window_.work_page->scene_view->picture(), file](const Task&) -> Result<void> {
        // A scan without a thumbnail is listed with a drawing in its place.
        (void)picture.scaled(288, 216, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation)
            .save(file);
        return {};
      },
      [](const Result<void>&) {});
}

}  // namespace gyre
