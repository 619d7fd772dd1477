// The turntable and the camera that are open, each served by a thread of its own.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QObject>

#include "app/job_runner.h"
#include "app/latest.h"
#include "app/rig.h"
#include "core/scan/device_info.h"
#include "core/scan/frame.h"

namespace gyre {

// Belongs to the window's thread and never waits in it. Opening moves nothing, and nothing is moved
// before confirmTurntable(): a board that answers may drive a mill.
class DeviceSession final : public QObject {
  Q_OBJECT

 public:
  explicit DeviceSession(RigOptions options, QObject* parent = nullptr);
  ~DeviceSession() override;

  bool isOpen() const { return rig_ != nullptr; }
  bool mayMove() const { return isOpen() && confirmed_; }
  const std::shared_ptr<Rig>& rig() const { return rig_; }
  const QString& turntableWord() const { return turntable_word_; }
  const QString& cameraWord() const { return camera_word_; }
  bool turnedByHand() const { return turntable_word_.startsWith("hand"); }
  const RigOptions& options() const { return options_; }

  // A job that has turntable and camera to itself; the live picture pauses meanwhile.
  void runAlone(JobRunner::Job job, JobRunner::Done done);
  // The running job ends soon, and the table stands.
  void requestStop();
  bool busy() const { return table_jobs_.busy() || camera_jobs_.busy(); }

 public Q_SLOTS:
  void open(const QString& turntable, const QString& camera);
  void close();
  void confirmTurntable();
  void tellLock();     // whether the board is locked: lockTold()
  void allowUnlock();  // a person's word for that
  void turnByDeg(double by_deg);
  void turnToDeg(double to_deg);
  void releaseMotor();
  void lockCamera();
  // Lets go of both and opens them again, the camera in this mode: "1920x1080@MJPG@30".
  void reopenInMode(const QString& mode);
  void startPreview();

 Q_SIGNALS:
  void opening();
  void opened(const gyre::TurntableInfo& turntable, const gyre::CameraInfo& camera);
  void closed();
  void openFailed(const gyre::Error& error);
  void failed(const gyre::Error& error);
  void angleKnownDeg(double angle_deg);
  void lockTold(const QString& lock);  // why the board moves nothing until it may be unlocked
  void cameraTold(const gyre::CameraInfo& camera);
  void frameArrived(const gyre::FramePtr& frame);
  void progressed(double fraction, const QString& stage);
  void idle();  // no job runs any more

 private:
  void openWith(const RigOptions& options, const QString& turntable, const QString& camera);
  void move(std::function<double(double now_deg)> target_deg);
  void noteIdle();

  const RigOptions options_;
  std::optional<QString> reopen_in_;  // once both are closed
  std::shared_ptr<Rig> rig_;
  QString turntable_word_;
  QString camera_word_;
  bool confirmed_ = false;
  bool preview_failed_ = false;
  Latest<FramePtr> newest_;
  JobRunner table_jobs_;
  JobRunner camera_jobs_;
};

}  // namespace gyre
