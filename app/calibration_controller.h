// Does what the calibration wizard asks for: looks at targets, turns the table, keeps the result.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <QObject>

#include "app/device_session.h"
#include "app/job_runner.h"
#include "core/calib/match/find_target.h"
#include "core/pipeline/calibrate.h"
#include "core/scan/target_sight.h"
#include "core/scan/target_sketch.h"
#include "ui/calibration_facts.h"
#include "ui/calibration_wizard/calibration_wizard.h"

namespace gyre {

using CalibrationOutcomePtr = std::shared_ptr<const CalibrationOutcome>;

// Belongs to the window's thread and never waits in it. Live pictures are looked at in a thread of
// its own, the newest only; turning is done in the device session's.
class CalibrationController final : public QObject {
  Q_OBJECT

 public:
  explicit CalibrationController(DeviceSession& devices, QObject* parent = nullptr);

  const CalibrationOutcomePtr& outcome() const { return outcome_; }
  bool turning() const { return turning_; }

 public Q_SLOTS:
  void offerTargets();
  void chooseTarget(const gyre::TargetChoice& choice);
  void print(const QString& word, const QString& page, const QString& folder);
  // What live pictures are looked at for from now on.
  void watch(gyre::WizardStep step);
  void stopWatching();
  // Live pictures are judged by how sharp and bright they are, before anything else.
  void watchFocus();
  void stopWatchingFocus() { watches_focus_ = false; }
  void lookAt(const gyre::FramePtr& frame);
  // The lens that may be kept when only the camera's place is measured.
  void knowLens(const gyre::CameraModel& lens);
  // Six corners are asked for, one after another, and shown by clicks in the live picture.
  void beginHand();
  void cancelHand();
  void pick(const Eigen::Vector2d& pixel);
  void turn();
  void stop();
  // Writes the result, with the picture beside it by which a bump is told later.
  void save(const std::filesystem::path& file);

 Q_SIGNALS:
  void targetsOffered(const std::vector<gyre::TargetOffer>& offers);
  void targetReady(const gyre::TargetSketch& sketch);
  void targetRefused(const gyre::Error& why);
  void printed(const QString& file);
  void focusSeen(const gyre::FocusFacts& facts);
  void sightSeen(const gyre::TargetSight& sight);
  void cornerAsked(std::optional<int> corner);  // of the sketch's; nothing when no longer
  void picksChanged(const std::vector<Eigen::Vector2d>& pixels);
  void pictureTaken(const gyre::FramePtr& frame, const gyre::TargetSight& sight);
  void progressed(double fraction, const QString& stage);
  void stopped();
  void turnFailed(const gyre::Error& why);
  void measured(const gyre::CalibrationOutcomePtr& outcome);
  void saved(const QString& file);
  void failed(const gyre::Error& error);

 private:
  struct Chosen;  // the target as it truly is, with its choice

  void loadTable();
  void lookAtFocus(const FramePtr& frame);
  void lookForTarget(const FramePtr& frame);
  void useClicks();

  DeviceSession& devices_;
  std::optional<WizardStep> watched_;
  std::shared_ptr<const Chosen> chosen_;
  std::optional<CameraModel> lens_;
  FindTargetOptions shown_;  // where a person has shown the target, and through what lens
  std::optional<std::vector<Eigen::Vector2d>> picks_;  // while corners are asked for
  FramePtr newest_;
  CalibrationOutcomePtr outcome_;
  double sharpest_ = 0.0;
  bool watches_focus_ = false;
  bool turning_ = false;
  JobRunner look_jobs_;
};

}  // namespace gyre
