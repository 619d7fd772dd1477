// Step 4: how many views, and where they are kept.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/facts.h"

class QButtonGroup;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace gyre {

class ScanPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit ScanPanel(QWidget* parent = nullptr);

  int views() const;
  QString folder() const;
  void setFolder(const QString& folder);
  void setViews(int views);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  // What one view takes, so that the cost is known before it is paid.
  void showCost(double seconds_per_view, double megabytes_per_view);

 Q_SIGNALS:
  void startRequested();
  void resumeRequested();

 private:
  void showEstimate();

  QButtonGroup* kind_;
  QSpinBox* views_;
  QLineEdit* folder_;
  QLabel* estimate_;
  QPushButton* start_;
  QPushButton* resume_;
  double seconds_per_view_ = 0.0;
  double megabytes_per_view_ = 0.0;
};

}  // namespace gyre
