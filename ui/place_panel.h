// Step 3: the bare table is looked at once, then the object is put on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/facts.h"

class QLabel;
class QPushButton;

namespace gyre {

class PlacePanel final : public QWidget {
  Q_OBJECT

 public:
  explicit PlacePanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showEmptyTableTaken();
  void reset();

 Q_SIGNALS:
  void emptyTableRequested();
  void objectPlaced();

 private:
  QPushButton* take_;
  QLabel* taken_;
  QPushButton* placed_;
};

}  // namespace gyre
