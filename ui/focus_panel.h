// The object is framed and focused, then the camera is locked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/scan/device_info.h"
#include "ui/calibration_facts.h"
#include "ui/facts.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace gyre {

class Meter;

// The lens is set for the object, not for the target: focusing again later would change the camera.
class FocusPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit FocusPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showCamera(const gyre::CameraInfo& camera);  // as it was opened: nothing is locked yet
  void showFocus(const gyre::FocusFacts& facts);
  void showLocks(const gyre::CameraInfo& camera);

 Q_SIGNALS:
  void lockRequested();
  void modeChosen(const QString& mode);  // "1920x1080@MJPG": the camera is opened anew in it
  void goOnRequested();

 private:
  void buildModes(QLayout& card);
  void reset();

  QLabel* size_;
  QWidget* modes_row_;
  QComboBox* modes_;
  Meter* sharpness_;
  Meter* exposure_;
  QLabel* advice_;
  QPushButton* lock_;
  QLabel* locks_;
  QPushButton* go_on_;
};

}  // namespace gyre
