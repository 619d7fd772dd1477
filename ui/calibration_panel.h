// Step 2: what is known of camera and table, and where it comes from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/scan/calibration.h"

class QLabel;

namespace gyre {

class CalibrationPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showCalibration(const gyre::Calibration& calibration, const QString& source);
  void showNone();

 Q_SIGNALS:
  void fileChosen(const QString& path);

 private:
  QLabel* source_;
  QLabel* figures_;
};

}  // namespace gyre
