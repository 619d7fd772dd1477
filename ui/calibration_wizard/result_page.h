// Page 5: how good the calibration is, what to change, and keeping it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/calibration_report.h"
#include "ui/calibration_wizard/wizard_page.h"

class QLabel;
class QPushButton;

namespace gyre {

class ResultPage final : public WizardPage {
  Q_OBJECT

 public:
  ResultPage();

  QString hindrance() const override;

 public Q_SLOTS:
  // arrow_scale: how much the residuals are enlarged in the picture.
  void showReport(const gyre::CalibrationReport& report, double arrow_scale);
  void showKept(const QString& where);
  void reset();

 Q_SIGNALS:
  void keepRequested();
  void saveRequested(const QString& path);
  void againRequested();

 private:
  void askFile();

  QLabel* verdict_;
  QLabel* sentence_;
  QLabel* figures_;
  QLabel* remarks_;
  QPushButton* keep_;
  QPushButton* save_;
  QPushButton* again_;
  bool measured_ = false;
};

}  // namespace gyre
