// Page 3: the target is put on the table, and the live picture says whether it is seen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scan/target_sight.h"
#include "core/scan/target_sketch.h"
#include "ui/calibration_wizard/wizard_page.h"

class QLabel;
class QPushButton;

namespace gyre {

class TargetDrawing;

// Where the program does not find the target by itself, a person shows it six corners, one after
// another, in a drawing.
class PlaceTargetPage final : public WizardPage {
  Q_OBJECT

 public:
  PlaceTargetPage();

  QString hindrance() const override { return hindrance_; }

 public Q_SLOTS:
  void showSight(const gyre::TargetSight& sight);
  void showSketch(const gyre::TargetSketch& sketch);  // of the target that was chosen
  // The corner to click next, index into the sketch's; nothing when no clicks are wanted.
  void showAsked(std::optional<int> asked);
  void reset();  // another target, or the camera was opened anew

 Q_SIGNALS:
  void handRequested();  // the user wants to click
  void handCancelled();

 private:
  QLabel* faces_;
  QLabel* sentence_;
  QLabel* asking_;
  TargetDrawing* drawing_;
  QPushButton* hand_;
  TargetSketch sketch_;
  bool clicking_ = false;
  QString hindrance_;
};

}  // namespace gyre
