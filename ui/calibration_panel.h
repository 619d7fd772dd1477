// Step 3: what is known of camera and table, where it comes from, and the way to measure it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/scan/calibration_record.h"

class QLabel;
class QPushButton;
class QStackedWidget;

namespace gyre {

class CalibrationWizard;

// The wizard takes the panel's place until it is left; it then waits where it was.
class CalibrationPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationPanel(QWidget* parent = nullptr);

  CalibrationWizard* wizard;

  bool showsWizard() const;

 public Q_SLOTS:
  void showCalibration(const gyre::CalibrationRecord& record, const QString& source);
  void showNone();
  void allowMeasuring();  // turntable and camera are open
  void forbidMeasuring(const QString& why);
  void showWizard();
  void showOverview();

 Q_SIGNALS:
  void fileChosen(const QString& path);
  void wizardShown(bool shown);

 private:
  QWidget* buildOverview();

  QStackedWidget* stack_;
  QLabel* source_;
  QLabel* figures_;
  QLabel* quality_;
  QPushButton* measure_;
  QLabel* hindrance_;
};

}  // namespace gyre
