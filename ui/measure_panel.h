// Step 6: the lengths that were measured on the model, each beside what a caliper says.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

#include "core/scan/measurement.h"

class QAction;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QPushButton;
class QToolButton;

namespace gyre {

class MeasurePanel final : public QWidget {
  Q_OBJECT

 public:
  // The action turns measuring on and off; it is not the panel's.
  explicit MeasurePanel(QAction* measure, QWidget* parent = nullptr);

 public Q_SLOTS:
  // chosen: whose line is drawn; -1 for none.
  void showMeasurements(const std::vector<gyre::Measurement>& measurements, int chosen);
  void showKept(const QString& words);  // where the list is kept

 Q_SIGNALS:
  void chosen(int index);
  void caliperEntered(int index, double caliper_mm);  // 0: none
  void removeRequested(int index);

 private:
  void showChosen();
  int chosenRow() const;

  std::vector<Measurement> measurements_;
  QListWidget* list_;
  QLabel* words_;
  QDoubleSpinBox* caliper_mm_;
  QLabel* difference_;
  QPushButton* remove_;
  QLabel* kept_;
  QWidget* details_;
};

// How the length compares with the caliper, a line or two; empty without a caliper.
QString caliperWords(const Measurement& measurement);

}  // namespace gyre
