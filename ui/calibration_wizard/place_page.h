// Page 3: the target is put on the table, and the live picture says whether it is seen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/target_sight.h"
#include "ui/calibration_wizard/wizard_page.h"

class QLabel;

namespace gyre {

class PlaceTargetPage final : public WizardPage {
  Q_OBJECT

 public:
  PlaceTargetPage();

  QString hindrance() const override { return hindrance_; }

 public Q_SLOTS:
  void showSight(const gyre::TargetSight& sight);
  void reset();  // another target, or the camera was opened anew

 private:
  QLabel* faces_;
  QLabel* sentence_;
  QString hindrance_;
};

}  // namespace gyre
