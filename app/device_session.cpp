// The turntable and the camera that are open, each served by a thread of its own.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/device_session.h"

#include <utility>

#include "app/count_anew.h"
#include "app/free_hand.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr double kPreviewInterval_s = 0.12;  // a live picture; more would only warm the processor

struct Opened {
  std::shared_ptr<Rig> rig;
  TurntableInfo turntable;
  CameraInfo camera;
  double angle_deg = 0.0;
};

Error notConfirmed() {
  return {Error::Code::kRejected, "The table was not moved.",
          "Say first that this device is your turntable (step 1)."};
}

Error notInTheWindow() {
  return {Error::Code::kInvalidInput, "A table that is turned freely is for the command line.",
          "Use `gyre scan --turntable hand:free`, or turn by marks here: hand:36."};
}

}  // namespace

DeviceSession::DeviceSession(RigOptions options, QObject* parent)
    : QObject(parent),
      options_(std::move(options)),
      table_jobs_("gyre-table"),
      camera_jobs_("gyre-camera") {
  connect(&table_jobs_, &JobRunner::progressed, this, &DeviceSession::progressed);
  connect(&table_jobs_, &JobRunner::idle, this, &DeviceSession::noteIdle);
  connect(&camera_jobs_, &JobRunner::idle, this, &DeviceSession::noteIdle);
}

DeviceSession::~DeviceSession() { requestStop(); }

void DeviceSession::open(const QString& turntable, const QString& camera) {
  openWith(options_, turntable, camera);
}

void DeviceSession::openWith(const RigOptions& options, const QString& turntable,
                             const QString& camera) {
  if (isOpen() || table_jobs_.busy()) return;
  if (namesFreeHand(turntable.toStdString())) {
    Q_EMIT openFailed(notInTheWindow());
    return;
  }
  Q_EMIT opening();
  turntable_word_ = turntable;
  camera_word_ = camera;
  // Neither drives a machine.
  confirmed_ = namesSimulation(turntable.toStdString()) || turnedByHand();
  preview_failed_ = false;
  auto result = std::make_shared<Opened>();
  table_jobs_.start(
      [result, options, turntable_word = turntable.toStdString(),
       camera_word = camera.toStdString()](const Task& task) -> Result<void> {
        auto rig = openRig(turntable_word, camera_word, options, task);
        if (!rig) return rig.error();
        result->rig = std::make_shared<Rig>(std::move(rig).value());
        result->turntable = result->rig->turntable->info();
        result->camera = result->rig->camera->info();
        result->angle_deg = degFromRad(result->rig->turntable->angleRad());
        return {};
      },
      [this, result](const Result<void>& outcome) {
        if (!outcome) {
          Q_EMIT openFailed(outcome.error());
          return;
        }
        rig_ = std::exchange(result->rig, nullptr);
        Q_EMIT opened(result->turntable, result->camera);
        Q_EMIT angleKnownDeg(result->angle_deg);
      });
}

// The last owner is a job, so that the ports close in its thread.
void DeviceSession::close() {
  if (!isOpen()) return;
  camera_jobs_.requestStop();
  table_jobs_.start([rig = std::exchange(rig_, nullptr)](const Task&) { return Result<void>(); },
                    [this](const Result<void>&) { Q_EMIT closed(); });
}

void DeviceSession::reopenInMode(const QString& mode) {
  if (!isOpen() || table_jobs_.busy()) return;
  reopen_in_ = mode;
  close();
}

void DeviceSession::confirmTurntable() { confirmed_ = true; }

void DeviceSession::tellLock() {
  if (!isOpen()) return;
  auto lock = std::make_shared<QString>();
  table_jobs_.start(
      [rig = rig_, lock](const Task&) -> Result<void> {
        *lock = QString::fromStdString(rig->turntable->info().lock);
        return {};
      },
      [this, lock](const Result<void>&) { Q_EMIT lockTold(*lock); });
}

void DeviceSession::allowUnlock() {
  if (!isOpen()) return;
  table_jobs_.start(
      [rig = rig_](const Task&) -> Result<void> {
        rig->turntable->allowUnlock();
        return {};
      },
      [](const Result<void>&) {});
}

void DeviceSession::runAlone(JobRunner::Job job, JobRunner::Done done) {
  camera_jobs_.requestStop();
  table_jobs_.start(std::move(job), std::move(done));
}

void DeviceSession::requestStop() {
  if (rig_) rig_->turntable->stop();
  table_jobs_.requestStop();
  camera_jobs_.requestStop();
}

void DeviceSession::turnByDeg(double by_deg) {
  move([by_deg](double now_deg) { return now_deg + by_deg; });
}

void DeviceSession::turnToDeg(double to_deg) {
  move([to_deg](double) { return to_deg; });
}

void DeviceSession::move(std::function<double(double now_deg)> target_deg) {
  if (!isOpen()) return;
  if (!mayMove()) {
    Q_EMIT failed(notConfirmed());
    return;
  }
  auto angle_deg = std::make_shared<double>(0.0);
  table_jobs_.start(
      [rig = rig_, target_deg = std::move(target_deg), angle_deg](const Task& task) {
        Turntable& table = *rig->turntable;
        if (auto counted = countAnewIfLost(table); !counted) return counted;
        auto moved = table.moveTo(radFromDeg(target_deg(degFromRad(table.angleRad()))), task);
        *angle_deg = degFromRad(table.angleRad());
        return moved;
      },
      [this, angle_deg](const Result<void>& outcome) {
        if (!outcome && outcome.error().code != Error::Code::kCancelled) {
          Q_EMIT failed(outcome.error());
        }
        Q_EMIT angleKnownDeg(*angle_deg);
      });
}

void DeviceSession::releaseMotor() {
  if (!isOpen()) return;
  table_jobs_.start([rig = rig_](const Task&) { return rig->turntable->release(); },
                    [this](const Result<void>& outcome) {
                      if (!outcome) Q_EMIT failed(outcome.error());
                      tellLock();
                    });
}

void DeviceSession::lockCamera() {
  if (!isOpen()) return;
  auto told = std::make_shared<CameraInfo>();
  table_jobs_.start(
      [rig = rig_, told](const Task&) -> Result<void> {
        auto info = rig->camera->lockControls();
        if (!info) return info.error();
        *told = std::move(info).value();
        return {};
      },
      [this, told](const Result<void>& outcome) {
        if (outcome) {
          Q_EMIT cameraTold(*told);
        } else {
          Q_EMIT failed(outcome.error());
        }
      });
}

void DeviceSession::startPreview() {
  if (!isOpen() || busy() || preview_failed_) return;
  camera_jobs_.start(
      [this, rig = rig_](const Task& task) -> Result<void> {
        while (!task.stopRequested()) {
          auto frame = rig->camera->preview(task);
          if (!frame) return frame.error();
          if (newest_.put(std::move(frame).value())) {
            QMetaObject::invokeMethod(
                this,
                [this] {
                  if (auto newest = newest_.take()) Q_EMIT frameArrived(*newest);
                },
                Qt::QueuedConnection);
          }
          if (!task.sleepFor(kPreviewInterval_s)) break;
        }
        return {};
      },
      [this](const Result<void>& outcome) {
        if (!outcome && outcome.error().code != Error::Code::kCancelled) {
          preview_failed_ = true;  // said once; not again and again
          Q_EMIT failed(outcome.error());
        }
      });
}

// A job's own `done` still counts as busy: whatever goes on by itself begins here.
void DeviceSession::noteIdle() {
  startPreview();
  if (busy()) return;
  if (reopen_in_ && !isOpen()) {  // not before: the preview may have held the camera until now
    RigOptions options = options_;
    options.camera_mode = std::exchange(reopen_in_, std::nullopt)->toStdString();
    openWith(options, turntable_word_, camera_word_);
    return;
  }
  Q_EMIT idle();
}

}  // namespace gyre
