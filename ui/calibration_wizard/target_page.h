// Page 2: which target, printing it, and what a caliper says of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "ui/calibration_facts.h"
#include "ui/calibration_wizard/wizard_page.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;

namespace gyre {

// A target counts as chosen once it was read without an error.
class TargetPage final : public WizardPage {
  Q_OBJECT

 public:
  TargetPage();

  QString hindrance() const override { return hindrance_; }
  TargetChoice choice() const;

 public Q_SLOTS:
  void showOffers(const std::vector<gyre::TargetOffer>& offers);
  void showReady();                          // the chosen target can be used
  void showProblem(const gyre::Error& why);  // it cannot
  void allowKeepingLens();                   // a calibration of the camera is there
  void showPrinted(const QString& file);
  void useFile(const QString& path);  // a TARGET.json of one's own

 Q_SIGNALS:
  void targetChosen(const gyre::TargetChoice& choice);
  void printRequested(const QString& word, const QString& page, const QString& folder);

 private:
  void askFile();
  void askFolder();
  void announce();

  std::vector<TargetOffer> offers_;
  QComboBox* target_;
  QLabel* about_;
  QComboBox* page_;
  QDoubleSpinBox* right_mm_;
  QDoubleSpinBox* down_mm_;
  QCheckBox* keep_lens_;
  QLabel* state_;
  QString hindrance_;
};

}  // namespace gyre
