// What is the matter with the ports, in words with whole commands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QFrame>
#include <QString>

#include "core/scan/port_diagnosis.h"
#include "ui/facts.h"

class QLabel;
class QPushButton;

namespace gyre {

class DoctorCard final : public QFrame {
  Q_OBJECT

 public:
  explicit DoctorCard(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  // What is chosen as a turntable; what was told of another holds no longer.
  void showChosen(const QString& turntable);
  void showBegun();
  void showPorts(const std::vector<gyre::PortDiagnosis>& ports);
  void showStopped();

 Q_SIGNALS:
  void checkRequested();
  void stopRequested();

 private:
  void offer();

  QPushButton* check_;
  QLabel* told_;
  QPushButton* copy_;
  QString chosen_;
  ScanPhase phase_ = ScanPhase::kIdle;
  enum class State { kRest, kChecking } state_ = State::kRest;
};

// A sign and a few words: "✗ Not allowed".
QString portStateText(PortState state);

}  // namespace gyre
