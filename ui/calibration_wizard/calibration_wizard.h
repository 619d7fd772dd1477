// Leads from a locked camera to a measured rig, one action a page.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QWidget>

class QLabel;
class QPushButton;
class QStackedWidget;

namespace gyre {

class PlaceTargetPage;
class ResultPage;
class TargetPage;
class TurnPage;
class WizardPage;

enum class WizardStep { kTarget, kPlace, kTurn, kResult };
inline constexpr std::size_t kWizardSteps = 4;

// Knows nothing of cameras or tables: the pages are wired by whoever owns the wizard. Leaving keeps
// everything, so that one can come back to the same page.
class CalibrationWizard final : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationWizard(QWidget* parent = nullptr);

  TargetPage* target_page;
  PlaceTargetPage* place_page;
  TurnPage* turn_page;
  ResultPage* result_page;

  WizardStep step() const;

 public Q_SLOTS:
  void showStep(gyre::WizardStep step);

 Q_SIGNALS:
  void stepShown(gyre::WizardStep step);
  void leaveRequested();

 private:
  void goOn();
  void goBack();
  void showHindrance();
  WizardPage* page(std::size_t index) const { return pages_[index]; }

  std::array<WizardPage*, kWizardSteps> pages_{};
  QLabel* where_;
  QStackedWidget* stack_;
  QLabel* hindrance_;
  QPushButton* back_;
  QPushButton* next_;
  QPushButton* leave_;
};

}  // namespace gyre
