// Asks a person to turn the table by hand, and hears when it is done.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QFrame>

#include "ui/facts.h"

class QLabel;
class QPushButton;
class QShortcut;
class QTimer;

namespace gyre {

// Hidden until there is something to turn. Never modal: the live picture helps to turn.
class HandCard final : public QFrame {
  Q_OBJECT

 public:
  explicit HandCard(QWidget* parent = nullptr);

 public Q_SLOTS:
  void ask(const gyre::HandTurnFacts& turn);
  void settle();

 Q_SIGNALS:
  void done();  // the button, or the Enter key
  void stopRequested();

 private:
  void answer();

  QLabel* what_;
  QPushButton* done_;
  std::array<QShortcut*, 2> keys_{};
  QTimer* hide_soon_;  // the next question mostly comes before
};

// "Turn the table counter-clockwise, seen from above, by 5° to mark 3 (15°)."
QString handTurnText(const HandTurnFacts& turn);

}  // namespace gyre
