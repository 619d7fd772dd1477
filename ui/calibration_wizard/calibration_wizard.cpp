// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/calibration_wizard.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "ui/calibration_wizard/place_page.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_wizard/target_page.h"
#include "ui/calibration_wizard/turn_page.h"
#include "ui/parts.h"

namespace gyre {

CalibrationWizard::CalibrationWizard(QWidget* parent) : QWidget(parent) {
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  outer->addWidget(makeCard(card));
  where_ = makeLabel(QString(), "muted");
  stack_ = new QStackedWidget;
  target_page = new TargetPage;
  place_page = new PlaceTargetPage;
  turn_page = new TurnPage;
  result_page = new ResultPage;
  pages_ = {target_page, place_page, turn_page, result_page};
  for (WizardPage* one : pages_) {
    stack_->addWidget(one);
    connect(one, &WizardPage::hindranceChanged, this, &CalibrationWizard::showHindrance);
  }
  hindrance_ = makeLabel(QString(), "muted");
  hindrance_->setAccessibleName(tr("Why Next is not possible yet"));
  back_ = makeButton(tr("&Back"), tr("To the page before"));
  next_ = makePrimaryButton(tr("&Next"), tr("To the next page"));
  leave_ = makeButton(tr("Lea&ve"), tr("Leave for now; everything is kept to go on with later"));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(leave_);
  buttons->addWidget(back_);
  buttons->addWidget(next_, 1);
  // On top, where they stay in sight however long a page is.
  card->addWidget(where_);
  card->addLayout(buttons);
  card->addWidget(hindrance_);
  card->addWidget(makeRule());
  card->addWidget(stack_);
  outer->addStretch(1);
  connect(back_, &QPushButton::clicked, this, &CalibrationWizard::goBack);
  connect(next_, &QPushButton::clicked, this, &CalibrationWizard::goOn);
  connect(leave_, &QPushButton::clicked, this, &CalibrationWizard::leaveRequested);
  showStep(WizardStep::kTarget);
}

WizardStep CalibrationWizard::step() const {
  return static_cast<WizardStep>(stack_->currentIndex());
}

void CalibrationWizard::showStep(WizardStep step) {
  const int index = static_cast<int>(step);
  for (WizardPage* one : pages_) {  // only the page that is shown takes room
    one->setSizePolicy(QSizePolicy::Preferred, one == page(static_cast<std::size_t>(index))
                                                   ? QSizePolicy::Preferred
                                                   : QSizePolicy::Ignored);
  }
  stack_->setCurrentIndex(index);
  where_->setText(tr("Calibrate · page %1 of %2").arg(index + 1).arg(kWizardSteps));
  back_->setEnabled(index > 0);
  showHindrance();
  Q_EMIT stepShown(step);
}

void CalibrationWizard::goOn() {
  const auto index = static_cast<std::size_t>(stack_->currentIndex());
  if (!page(index)->hindrance().isEmpty()) return;
  if (index + 1 < kWizardSteps) {
    showStep(static_cast<WizardStep>(index + 1));
  } else {
    Q_EMIT leaveRequested();
  }
}

void CalibrationWizard::goBack() {
  const int index = stack_->currentIndex();
  if (index > 0) showStep(static_cast<WizardStep>(index - 1));
}

void CalibrationWizard::showHindrance() {
  const auto index = static_cast<std::size_t>(stack_->currentIndex());
  const QString why = page(index)->hindrance();
  hindrance_->setText(why);
  hindrance_->setVisible(!why.isEmpty());
  next_->setEnabled(why.isEmpty());
  next_->setText(index + 1 < kWizardSteps ? tr("&Next") : tr("Fi&nish"));
  next_->setToolTip(why.isEmpty() ? tr("To the next page") : why);
}

}  // namespace gyre
