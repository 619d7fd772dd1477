// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/hand_card.h"

#include <QHBoxLayout>
#include <QShortcut>
#include <QTimer>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr int kHideAfter_ms = 3000;

}  // namespace

HandCard::HandCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 12, 16, 12);
  row->setSpacing(kGap_px);
  what_ = makeLabel(QString(), "heading");
  what_->setAccessibleName(tr("How to turn the table"));
  row->addWidget(what_, 1);
  done_ = makePrimaryButton(tr("Done"), tr("The table stands there (Enter)"));
  auto* stop = makeButton(tr("Stop"), tr("Turn no more; what was captured is kept"));
  row->addWidget(done_);
  row->addWidget(stop);
  connect(done_, &QPushButton::clicked, this, &HandCard::answer);
  connect(stop, &QPushButton::clicked, this, &HandCard::stopRequested);
  constexpr std::array kKeys = {Qt::Key_Return, Qt::Key_Enter};
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    keys_[i] = new QShortcut(kKeys[i], this);
    keys_[i]->setAutoRepeat(false);
    keys_[i]->setContext(Qt::WindowShortcut);
    connect(keys_[i], &QShortcut::activated, this, &HandCard::answer);
  }
  hide_soon_ = new QTimer(this);
  hide_soon_->setSingleShot(true);
  hide_soon_->setInterval(kHideAfter_ms);
  connect(hide_soon_, &QTimer::timeout, this, &QWidget::hide);
  settle();
  hide();
}

void HandCard::ask(const HandTurnFacts& turn) {
  hide_soon_->stop();
  what_->setText(handTurnText(turn) + " " + tr("Then press Done, or the Enter key."));
  done_->setEnabled(true);
  for (QShortcut* key : keys_) key->setEnabled(true);
  show();
}

// A second press is for a question that has not come yet.
void HandCard::answer() {
  done_->setEnabled(false);
  for (QShortcut* key : keys_) key->setEnabled(false);
  what_->setText(tr("Taking the picture: do not touch the table."));
  Q_EMIT done();
}

void HandCard::settle() {
  const bool answered = !done_->isEnabled();
  for (QShortcut* key : keys_) key->setEnabled(false);
  done_->setEnabled(false);
  if (answered) {
    hide_soon_->start();
  } else {
    hide();
  }
}

QString handTurnText(const HandTurnFacts& turn) {
  const double by_deg = static_cast<double>(turn.marks) * turn.mark_deg;
  const QString by = QString::number(by_deg, 'g', 6);
  const QString to = QString::number(turn.to_deg, 'g', 6);
  return (turn.counter_clockwise
              ? HandCard::tr("Turn the table counter-clockwise, seen from above, by %1° to mark %2 "
                             "(%3°).")
              : HandCard::tr("Turn the table clockwise, seen from above, by %1° to mark %2 (%3°)."))
      .arg(by)
      .arg(turn.to_mark)
      .arg(to);
}

}  // namespace gyre
