// Where a scan stands and what may happen next: the one place that decides.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scan_controller.h"

#include <atomic>
#include <utility>

#include "app/calibration_run.h"
#include "app/pause_gate.h"
#include "app/scan_outcome.h"
#include "core/base/address.h"
#include "core/io/calibration_record_file.h"
#include "core/mesh/mesh_health.h"
#include "core/sim/rig.h"

namespace gyre {

struct ScanController::Live {
  std::atomic<int> views_done = 0;
  std::atomic<int> views_before = 0;
  std::atomic<int> views = 0;
  std::atomic<bool> objected = false;
  PauseGate gate;
  struct Update {
    TrackedFramePtr frame;
    PointCloudPtr cloud;
    std::optional<double> median_sigma_mm;
  };
  Latest<Update> newest;
};

ScanController::ScanController(RigOptions options, QObject* parent)
    : QObject(parent), devices_(std::move(options)), compute_jobs_("gyre-compute") {
  connect(&devices_, &DeviceSession::opened, this, &ScanController::devicesOpened);
  connect(&devices_, &DeviceSession::closed, this, &ScanController::devicesClosed);
  connect(&devices_, &DeviceSession::openFailed, this, [this](const Error& error) {
    setPhase(ScanPhase::kIdle);
    if (error.code != Error::Code::kCancelled) Q_EMIT failed(error);
  });
  connect(&devices_, &DeviceSession::failed, this, &ScanController::failed);
  connect(&devices_, &DeviceSession::progressed, this, &ScanController::progressed);
  connect(&compute_jobs_, &JobRunner::progressed, this, &ScanController::progressed);
  connect(&devices_, &DeviceSession::idle, this, &ScanController::noteIdle);
  connect(&compute_jobs_, &JobRunner::idle, this, &ScanController::noteIdle);
  connect(&editor_, &SurfaceEditor::idle, this, &ScanController::noteIdle);
  connect(&editor_, &SurfaceEditor::stopRequested, this, &ScanController::stopSurface);
}

ScanController::~ScanController() {
  if (live_) live_->gate.open();
}

void ScanController::setPhase(ScanPhase phase) {
  if (phase == phase_) return;
  phase_ = phase;
  Q_EMIT phaseChanged(phase);
}

bool ScanController::refuse(const QString& what, const QString& advice) {
  Q_EMIT failed({Error::Code::kRejected, what.toStdString(), advice.toStdString()});
  return false;
}

void ScanController::devicesOpened(const TurntableInfo& turntable) {
  Q_EMIT logged(tr("Connected: %1 on %2, camera %3")
                    .arg(QString::fromStdString(turntable.firmware), devices_.turntableWord(),
                         devices_.cameraWord()));
  empty_table_.reset();
  const SimulatedRoom* room = devices_.rig()->room.get();
  if (room != nullptr && room->camera != nullptr) {
    know(trueRecord(room->settings), {}, tr("The simulated rig's own calibration."));
  }
  setPhase(ScanPhase::kReady);
}

void ScanController::devicesClosed() {
  Q_EMIT logged(tr("Disconnected"));
  setPhase(ScanPhase::kIdle);
}

void ScanController::know(CalibrationRecord record, const std::filesystem::path& reference,
                          const QString& source) {
  calibration_ = std::move(record);
  reference_ = reference;
  Q_EMIT calibrationKnown(*calibration_, source);
}

bool ScanController::useCalibration(const std::filesystem::path& file) {
  auto read = readCalibrationRecord(file);
  if (!read) {
    Q_EMIT failed(read.error());
    return false;
  }
  know(std::move(read).value(), referenceFor(file), QString::fromStdString(file.string()));
  return true;
}

bool ScanController::readyToScan() {
  if (isCapturing(phase_) || phase_ == ScanPhase::kFinishing || phase_ == ScanPhase::kQuickLook) {
    return false;
  }
  if (!devices_.isOpen()) {
    return refuse(tr("Nothing is connected."), tr("Connect a turntable and a camera (step 1)."));
  }
  if (!devices_.mayMove()) {
    return refuse(tr("The table may not be moved yet."),
                  tr("Say first that this device is your turntable (step 1)."));
  }
  if (!calibration_ || !calibration_->calibration.cam_from_table) {
    return refuse(tr("The camera's place at the table is not known."),
                  tr("Open a calibration made with this camera and table (step 3)."));
  }
  return true;
}

void ScanController::startScan(const ScanRequest& request) {
  if (readyToScan()) run(planFor(ScanBegin::kNew, request));
}

void ScanController::resumeScan() { resumeWith(TakeUp::kProve); }
void ScanController::resumeTrusting() { resumeWith(TakeUp::kTrust); }

void ScanController::resumeWith(TakeUp take_up) {
  if (folder_.empty() || !readyToScan()) return;
  ScanRequest request;
  request.folder = folder_;
  if (facts_.views > 0) request.views = facts_.views;
  const bool in_place = stopped_rig_.lock() == devices_.rig();
  ScanPlan plan = planFor(in_place ? ScanBegin::kResumedInPlace : ScanBegin::kResumed, request);
  plan.take_up = take_up;
  run(plan);
}

ScanPlan ScanController::planFor(ScanBegin begin, const ScanRequest& request) const {
  ScanPlan plan;
  plan.folder = request.folder;
  plan.begin = begin;
  plan.settings.title = request.title.toStdString();
  plan.settings.turntable = devices_.turntableWord().toStdString();
  plan.settings.camera = withoutPassword(devices_.cameraWord().toStdString());
  plan.settings.views = request.views;
  plan.calibration = *calibration_;
  plan.reference = reference_;
  plan.empty_table = empty_table_;
  return plan;
}

// What it sets is called in other threads.
ScanObserver ScanController::observerOf(const std::shared_ptr<Live>& live) {
  ScanObserver observer;
  observer.on_remark = [this](const std::string& remark) {
    QMetaObject::invokeMethod(
        this, [this, remark] { Q_EMIT noticed(QString::fromStdString(remark), QString()); },
        Qt::QueuedConnection);
  };
  observer.on_objection = [live](const Error&) { live->objected = true; };
  observer.on_begin = [this, live](int views_done, int views) {
    live->views_done = views_done;
    live->views_before = views_done;
    live->views = views;
    QMetaObject::invokeMethod(this, &ScanController::deliver, Qt::QueuedConnection);
  };
  observer.on_view = [live](const FramePtr&, const Task& task) {
    ++live->views_done;
    live->gate.wait(task.stopToken());
  };
  observer.on_tracked = [this, live](TrackedFrame frame, const PointCloudPtr& cloud) {
    Live::Update update{std::make_shared<const TrackedFrame>(std::move(frame)), cloud,
                        medianSigmaMm(*cloud)};
    if (live->newest.put(std::move(update))) {
      QMetaObject::invokeMethod(this, &ScanController::deliver, Qt::QueuedConnection);
    }
  };
  observer.on_captured = [this] {
    QMetaObject::invokeMethod(
        this, [this] { setPhase(ScanPhase::kFinishing); }, Qt::QueuedConnection);
  };
  return observer;
}

void ScanController::run(const ScanPlan& plan) {
  auto live = std::make_shared<Live>();
  auto result = std::make_shared<Outcome>();
  live_ = live;
  folder_ = plan.folder;
  cloud_ = nullptr;
  alpha_shape_.reset();
  editor_.clear();
  Q_EMIT modelChanged();
  Q_EMIT passesKnown({});
  const int kept = plan.begin == ScanBegin::kNew ? 0 : facts_.views_done;
  facts_ = {};
  facts_.views_done = kept;  // until the scan tells
  live->views_done = kept;
  live->views_before = kept;
  facts_.views = plan.settings.views;
  clock_.start();
  paused_ms_ = 0;

  stopped_rig_.reset();
  setPhase(ScanPhase::kScanning);
  Q_EMIT factsChanged(facts_);
  Q_EMIT logged(tr("Scan into %1").arg(QString::fromStdString(folder_.string())));
  devices_.runAlone(
      [rig = devices_.rig(), plan, observer = observerOf(live),
       result](const Task& task) -> Result<void> {
        auto done = runScanSession(*rig, plan, observer, task);
        if (!done) return done.error();
        result->cloud = std::make_shared<const PointCloud>(std::move(done->reconstruction.cloud));
        if (!done->results.mesh.triangles.empty()) {
          result->health = meshHealth(done->results.mesh);
          result->mesh = std::make_shared<const Mesh>(std::move(done->results.mesh));
        }
        result->problem = done->problem;
        return {};
      },
      [this, result](const Result<void>& outcome) { finished(outcome, result); });
}

void ScanController::deliver() {
  if (!live_) return;
  auto update = live_->newest.take();
  if (live_->views > 0) facts_.views = live_->views;
  facts_.views_done = live_->views_done;
  facts_.elapsed_s = static_cast<double>(clock_.elapsed() - paused_ms_) / 1000.0;
  const int captured = facts_.views_done - live_->views_before;
  if (captured > 0)
    facts_.left_s = facts_.elapsed_s / captured * (facts_.views - facts_.views_done);
  if (update) {
    cloud_ = update->cloud;
    alpha_shape_.reset();
    facts_.points = cloud_->points.size();
    facts_.median_sigma_mm = update->median_sigma_mm;
    Q_EMIT tracked(update->frame);
    Q_EMIT cloudGrew(cloud_);
  }
  Q_EMIT factsChanged(facts_);
}

void ScanController::finished(const Result<void>& outcome, const std::shared_ptr<Outcome>& result) {
  deliver();
  const bool was_objected = std::exchange(live_, nullptr)->objected;
  if (!outcome) {
    setPhase(ScanPhase::kFailed);
    if (outcome.error().code == Error::Code::kCancelled) {
      stopped_rig_ = devices_.rig();
      Q_EMIT noticed(tr("Stopped. What was captured is kept in %1.")
                         .arg(QString::fromStdString(folder_.string())),
                     tr("Step 5 can go on with this scan."));
    } else if (was_objected) {
      Q_EMIT this->objected(outcome.error());
    } else {
      Q_EMIT failed(outcome.error());
    }
    return;
  }
  cloud_ = result->cloud;
  alpha_shape_.reset();
  facts_.views_done = facts_.views;
  facts_.left_s.reset();
  facts_.points = cloud_->points.size();
  facts_.median_sigma_mm = medianSigmaMm(*cloud_);
  setPhase(ScanPhase::kDone);
  Q_EMIT factsChanged(facts_);
  Q_EMIT cloudGrew(cloud_);
  Q_EMIT modelChanged();
  showMesh(result);
}

void ScanController::pause() {
  if (phase_ != ScanPhase::kScanning) return;
  live_->gate.close();
  paused_at_ms_ = clock_.elapsed();
  setPhase(ScanPhase::kPaused);
}

void ScanController::resume() {
  if (phase_ != ScanPhase::kPaused) return;
  paused_ms_ += clock_.elapsed() - paused_at_ms_;
  setPhase(ScanPhase::kScanning);
  live_->gate.open();
}

void ScanController::stop() {
  if (isCapturing(phase_)) setPhase(ScanPhase::kStopping);
  devices_.requestStop();
  next_surface_.reset();
  compute_jobs_.requestStop();
  editor_.requestStop();
}

void ScanController::shutDown() {
  shutting_down_ = true;
  stop();
  devices_.close();
  QMetaObject::invokeMethod(this, &ScanController::noteIdle, Qt::QueuedConnection);
}

void ScanController::noteIdle() {
  if (devices_.busy() || compute_jobs_.busy() || editor_.busy()) return;
  Q_EMIT rested();
  if (shutting_down_) Q_EMIT quiet();
}

}  // namespace gyre
