// Step 1: which turntable and which camera, what they say of themselves, and small moves by hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

#include "core/scan/device_info.h"
#include "core/scan/port_diagnosis.h"
#include "ui/facts.h"

class QComboBox;
class QDoubleSpinBox;
class QFrame;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace gyre {

class DoctorCard;

// Ports and cameras are listed without being opened. Moving is offered only after the user has said
// that the identified device is a turntable.
class DevicePanel final : public QWidget {
  Q_OBJECT

 public:
  explicit DevicePanel(QWidget* parent = nullptr);

  QString turntable() const;  // a port, hand:MARKS or sim[:OBJECT], as for commands
  QString camera() const;
  void choose(const QString& turntable, const QString& camera);

 public Q_SLOTS:
  void showPorts(const std::vector<gyre::PortInfo>& ports);
  void showCameras(const std::vector<gyre::CameraDeviceInfo>& cameras);
  void showPhase(gyre::ScanPhase phase);
  void showTurntable(const gyre::TurntableInfo& info);
  void showCamera(const gyre::CameraInfo& info);
  void showAngleDeg(double angle_deg);
  void askWhetherTurntable();  // hides the moves until the user says yes
  void allowMoving();
  // Asks whether a locked board may be unlocked; lock: why it is, and what to do. An empty text
  // takes the question away.
  void askToUnlock(const QString& lock);
  // While ports are being checked nothing is connected.
  void showChecking();
  void showChecked(const std::vector<gyre::PortDiagnosis>& ports);
  void showCheckStopped();

 Q_SIGNALS:
  void refreshRequested();
  void connectRequested(const QString& turntable, const QString& camera);
  void disconnectRequested();
  void checkRequested(const QString& turntable);  // what is the matter with it, and all others
  void checkStopRequested();
  void turntableConfirmed();
  void unlockAllowed();
  void turnRequestedDeg(double by_deg);
  void angleRequestedDeg(double to_deg);
  void releaseRequested();

 private:
  void buildChoice(QVBoxLayout& layout);
  void buildQuestion(QVBoxLayout& layout);
  void buildLock(QVBoxLayout& layout);
  void buildMoves(QVBoxLayout& layout);
  void buildCamera(QVBoxLayout& layout);
  void showHindrance();
  void offerConnecting();

  QComboBox* turntable_;
  QComboBox* camera_;
  QLabel* hindrance_;
  QPushButton* connect_;
  QPushButton* disconnect_;
  DoctorCard* doctor_ = nullptr;
  bool idle_ = true;
  bool checking_ = false;
  QFrame* question_;
  QLabel* question_text_;
  QFrame* lock_;
  QLabel* lock_text_;
  QFrame* moves_;
  QLabel* firmware_;
  QLabel* angle_;
  QDoubleSpinBox* target_deg_;
  QFrame* camera_card_;
  QLabel* camera_text_;
};

}  // namespace gyre
