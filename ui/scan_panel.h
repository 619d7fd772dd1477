// Step 5: how many views, and where they are kept.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QWidget>

#include "core/base/result.h"
#include "ui/facts.h"

class QButtonGroup;
class QFrame;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

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
  void showCost(const gyre::ScanCost& cost);
  // What there is to know of so many views on this table; empty: nothing.
  void showViewsRemark(const QString& remark);
  void showFacts(const gyre::ScanFacts& facts);  // whether views of the scan are missing
  // The pictures show that not all stands as it stood: asks whether to go on all the same. The
  // question stands until it is answered, or a scan goes on.
  void askTrust(const gyre::Error& objection);

 Q_SIGNALS:
  void startRequested();
  void resumeRequested();
  void trustGiven();
  void viewsChanged(int views);
  void folderChanged(const QString& folder);  // its disk is another one, maybe

 private:
  void addViewChoice(QVBoxLayout& card);
  void addFolderChoice(QVBoxLayout& card);
  void addTrustQuestion(QVBoxLayout& layout);
  void offerResuming();
  void showEstimate();

  QButtonGroup* kind_;
  QSpinBox* views_;
  QLineEdit* folder_;
  QLabel* estimate_;
  QPushButton* start_;
  QPushButton* resume_;
  QLabel* no_room_;
  QLabel* views_remark_;
  QFrame* trust_;
  QLabel* objection_;
  ScanPhase phase_ = ScanPhase::kIdle;
  bool unfinished_ = false;
  std::optional<ScanCost> cost_;
};

}  // namespace gyre
