// Page 1: the object is framed and focused, then the camera is locked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/device_info.h"
#include "ui/calibration_facts.h"
#include "ui/calibration_wizard/wizard_page.h"

class QLabel;

namespace gyre {

class Meter;

// The lens is set for the object, not for the target: focusing again later would change the camera.
class FocusPage final : public WizardPage {
  Q_OBJECT

 public:
  FocusPage();

  QString hindrance() const override;

 public Q_SLOTS:
  void showFocus(const gyre::FocusFacts& facts);
  void showLocks(const gyre::CameraInfo& camera);

 Q_SIGNALS:
  void lockRequested();

 private:
  Meter* sharpness_;
  Meter* exposure_;
  QLabel* advice_;
  QLabel* locks_;
  bool locked_ = false;
};

}  // namespace gyre
