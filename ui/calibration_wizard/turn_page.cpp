// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/turn_page.h"

#include <QHBoxLayout>
#include <QProgressBar>
#include <QVBoxLayout>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr int kProgressSteps = 1000;

}  // namespace

TurnPage::TurnPage()
    : WizardPage(tr("Let the table turn"), "turn",
                 tr("Press Start. First the table makes tiny moves to learn how far and which way "
                    "it turns, then one whole turn in steps.")) {
  start_ = makePrimaryButton(tr("&Start turning"), tr("Measure camera and table with the target"));
  stop_ = makeButton(tr("S&top"), tr("Stop the table now; nothing is changed"));
  progress_ = new QProgressBar;
  progress_->setRange(0, kProgressSteps);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress of the calibration"));
  words_ = makeLabel(QString(), "muted");
  auto* row = new QHBoxLayout;
  row->addWidget(start_, 1);
  row->addWidget(stop_);
  body().addLayout(row);
  body().addWidget(progress_);
  body().addWidget(words_);
  body().addStretch(1);
  connect(start_, &QPushButton::clicked, this, &TurnPage::startRequested);
  connect(stop_, &QPushButton::clicked, this, &TurnPage::stopRequested);
  setState(State::kIdle, tr("About two minutes. Keep hands off the table."));
}

QString TurnPage::hindrance() const {
  switch (state_) {
    case State::kIdle:
      return tr("Let the table turn first.");
    case State::kRunning:
      return tr("The table is turning.");
    case State::kDone:
      return {};
  }
  return {};
}

void TurnPage::showRunning(double fraction, const QString& stage) {
  progress_->setValue(qRound(kProgressSteps * fraction));
  if (state_ == State::kRunning) {
    words_->setText(stage);
  } else {
    setState(State::kRunning, stage);
  }
}

void TurnPage::showStopped() { setState(State::kIdle, tr("Stopped. Nothing was changed.")); }

void TurnPage::showFailure(const Error& why) {
  setState(State::kIdle, QString::fromStdString(why.sentence()));
}

void TurnPage::showDone() {
  progress_->setValue(kProgressSteps);
  setState(State::kDone, tr("✓ Measured."));
}

void TurnPage::setState(State state, const QString& words) {
  state_ = state;
  start_->setEnabled(state != State::kRunning);
  stop_->setEnabled(state == State::kRunning);
  if (state == State::kIdle) progress_->setValue(0);
  words_->setText(words);
  Q_EMIT hindranceChanged();
}

}  // namespace gyre
