// The first page: try the demo, begin a scan, open one, or go on with a recent one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

#include "ui/facts.h"

class QAbstractButton;
class QLabel;
class QListWidget;

namespace gyre {

class StartPage final : public QWidget {
  Q_OBJECT

 public:
  explicit StartPage(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showRecent(const std::vector<gyre::RecentScan>& scans);
  void showDevices(const QString& sentence);
  void showCalibration(const QString& sentence);  // the one in use last; empty: none

 Q_SIGNALS:
  void demoRequested();
  void newScanRequested();
  void openRequested();
  void recentChosen(const QString& folder);
  void shown();  // what it lists may have changed

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QListWidget* recent_;
  QLabel* nothing_recent_;
  QLabel* devices_;
  QLabel* calibration_;
};

}  // namespace gyre
