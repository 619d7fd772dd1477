// Step 4: the bare table is looked at once, then the object on it from all sides.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QWidget>

#include "core/scan/usable_cylinder.h"
#include "ui/facts.h"

class QLabel;
class QPushButton;

namespace gyre {

class QuickLookCard;

class PlacePanel final : public QWidget {
  Q_OBJECT

 public:
  explicit PlacePanel(QWidget* parent = nullptr);

  QuickLookCard* quick_look;  // a child

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showEmptyTableTaken();
  // In which the object should stand; nothing while the camera's place is not known.
  void showUsable(const std::optional<gyre::UsableCylinder>& cylinder);
  void reset();

 Q_SIGNALS:
  void emptyTableRequested();
  void objectPlaced();

 private:
  QPushButton* take_;
  QLabel* taken_;
  QLabel* usable_;
  QPushButton* placed_;
};

}  // namespace gyre
