// The quick look around the object: its button, what was found in words, and the poor pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QFrame>

#include "core/scan/quick_look.h"
#include "ui/facts.h"

class QGridLayout;
class QLabel;
class QPushButton;

namespace gyre {

// What it tells forbids nothing: a scan may be started whatever was found.
class QuickLookCard final : public QFrame {
  Q_OBJECT

 public:
  explicit QuickLookCard(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showLook(const gyre::QuickLookPtr& look);  // null: what was shown holds no longer

 Q_SIGNALS:
  void lookRequested();
  void stopRequested();

 private:
  void showPictures(const QuickLook& look);
  void reveal();

  QPushButton* look_;
  QLabel* verdict_;
  QLabel* findings_;
  QLabel* pictures_text_;
  QWidget* pictures_;
  QGridLayout* grid_;
  ScanPhase phase_ = ScanPhase::kIdle;
};

}  // namespace gyre
