// Page 4: the table turns by itself while the target is measured.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "ui/calibration_wizard/wizard_page.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace gyre {

class TurnPage final : public WizardPage {
  Q_OBJECT

 public:
  TurnPage();

  QString hindrance() const override;

 public Q_SLOTS:
  void showRunning(double fraction, const QString& stage);
  void showStopped();
  void showFailure(const gyre::Error& why);
  void showDone();

 Q_SIGNALS:
  void startRequested();
  void stopRequested();

 private:
  enum class State { kIdle, kRunning, kDone };
  void setState(State state, const QString& words);

  State state_ = State::kIdle;
  QPushButton* start_;
  QPushButton* stop_;
  QProgressBar* progress_;
  QLabel* words_;
};

}  // namespace gyre
