// Several passes of one object: scanned again after it was turned over, and merged.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QFrame>
#include <QString>

#include "core/base/result.h"
#include "core/scan/scan_pass.h"
#include "ui/facts.h"

class QLabel;
class QPushButton;

namespace gyre {

class PassesCard final : public QFrame {
  Q_OBJECT

 public:
  explicit PassesCard(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showOffer(const gyre::PassOffer& offer);
  // How the passes of the model fit; empty: it is not merged, and what was told holds no longer.
  void showPasses(const std::vector<gyre::ScanPass>& passes);
  void showRefusal(const gyre::Error& error);

 Q_SIGNALS:
  void turnOverRequested();
  void mergeRequested();                         // with the pass before this one
  void mergeWithRequested(const QString& scan);  // its folder
  void stopRequested();

 private:
  void build();
  void askForPass();
  void offer();
  void tell(const QString& text);
  void reveal();

  QPushButton* turn_over_;
  QPushButton* merge_;
  QPushButton* merge_with_;
  QPushButton* stop_;
  QLabel* told_;
  PassOffer offer_;
  ScanPhase phase_ = ScanPhase::kIdle;
};

// What the fit of the passes tells, in sentences; empty for fewer than two passes.
QString passWords(const std::vector<ScanPass>& passes);

}  // namespace gyre
