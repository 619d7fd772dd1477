// How far the scan is, in figures, and the three buttons that are always there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

#include "ui/facts.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace gyre {

class JobBar final : public QFrame {
  Q_OBJECT

 public:
  explicit JobBar(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showFacts(const gyre::ScanFacts& facts);
  // Progress of other work: fraction in [0, 1].
  void showProgress(double fraction, const QString& stage);
  // That work is over: the scan's own phase and facts again.
  void showRest();

 Q_SIGNALS:
  void startRequested();
  void pauseRequested();
  void resumeRequested();
  void stopRequested();

 private:
  QLabel* addFigure(QLayout& layout, const QString& name, const QString& tip);

  QProgressBar* bar_;
  QLabel* stage_;
  QLabel* view_;
  QLabel* elapsed_;
  QLabel* left_;
  QLabel* points_;
  QLabel* sigma_;
  QPushButton* start_;
  QPushButton* pause_;
  QPushButton* stop_;
  ScanPhase phase_ = ScanPhase::kIdle;
  ScanFacts facts_;
};

// The phase in words for people.
QString phaseText(ScanPhase phase);

}  // namespace gyre
