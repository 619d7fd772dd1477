// The seven steps of a scan, each with a sign and its state in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/step_list.h"

#include <QButtonGroup>
#include <QPainter>
#include <QVBoxLayout>

#include "ui/theme.h"

namespace gyre {
namespace {

QString stateText(StepState state) {
  switch (state) {
    case StepState::kTodo:
      return StepList::tr("to do");
    case StepState::kNow:
      return StepList::tr("now");
    case StepState::kDone:
      return StepList::tr("done");
    case StepState::kAttention:
      return StepList::tr("needs attention");
  }
  return {};
}

QColor stateColour(StepState state) {
  const ThemeColours colours = themeColours();
  switch (state) {
    case StepState::kTodo:
      return colours.muted;
    case StepState::kNow:
      return colours.accent;
    case StepState::kDone:
      return colours.good;
    case StepState::kAttention:
      return colours.warning;
  }
  return {};
}

}  // namespace

StepRow::StepRow(int number, const QString& title, QWidget* parent)
    : QAbstractButton(parent), number_(number) {
  setText(title);
  setCheckable(true);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setState(StepState::kTodo);
}

void StepRow::setState(StepState state) {
  state_ = state;
  setAccessibleName(tr("Step %1, %2: %3").arg(number_).arg(text(), stateText(state)));
  update();
}

void StepRow::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const ThemeColours colours = themeColours();
  const QRectF ground = QRectF(rect()).adjusted(1, 1, -1, -1);
  if (isChecked()) {
    QColor tint = colours.accent;
    tint.setAlpha(34);
    painter.setPen(Qt::NoPen);
    painter.setBrush(tint);
    painter.drawRoundedRect(ground, 8, 8);
  }
  if (hasFocus()) {
    painter.setPen(QPen(colours.accent, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(ground, 8, 8);
  }
  paintSign(painter, {10, 0.5 * height() - 12, 24, 24});

  QFont title_font = font();
  title_font.setWeight(isChecked() ? QFont::DemiBold : QFont::Normal);
  painter.setFont(title_font);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRect(46, 4, width() - 52, height() / 2 - 2), Qt::AlignBottom, text());
  QFont state_font = font();
  state_font.setPointSizeF(0.86 * state_font.pointSizeF());
  painter.setFont(state_font);
  painter.setPen(stateColour(state_));
  painter.drawText(QRect(46, height() / 2 + 2, width() - 52, height() / 2 - 4), Qt::AlignTop,
                   stateText(state_));
}

void StepRow::paintSign(QPainter& painter, const QRectF& circle) const {
  const QColor colour = stateColour(state_);
  const bool filled = state_ != StepState::kTodo;
  painter.setPen(QPen(colour, 1.6));
  painter.setBrush(filled ? QBrush(colour) : Qt::NoBrush);
  painter.drawEllipse(circle.adjusted(1, 1, -1, -1));
  if (state_ == StepState::kDone) {
    painter.setPen(QPen(Qt::white, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    const QPointF at = circle.topLeft();
    painter.drawPolyline(
        QPolygonF({at + QPointF(7, 12.5), at + QPointF(10.8, 16), at + QPointF(17, 8.5)}));
    return;
  }
  QFont sign_font = font();
  sign_font.setBold(true);
  painter.setFont(sign_font);
  painter.setPen(filled ? QColor(Qt::white) : colour);
  painter.drawText(circle, Qt::AlignCenter,
                   state_ == StepState::kAttention ? QString("!") : QString::number(number_));
}

StepList::StepList(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  auto* group = new QButtonGroup(this);
  const std::array<QString, kStepCount> titles = {
      tr("Connect"), tr("Frame and focus"), tr("Calibrate"), tr("Place the object"),
      tr("Scan"),    tr("Surface"),         tr("Export")};
  for (std::size_t i = 0; i < kStepCount; ++i) {
    rows_[i] = new StepRow(static_cast<int>(i) + 1, titles[i]);
    group->addButton(rows_[i], static_cast<int>(i));
    layout->addWidget(rows_[i]);
  }
  rows_[0]->setChecked(true);
  connect(group, &QButtonGroup::idClicked, this,
          [this](int id) { Q_EMIT stepChosen(static_cast<Step>(id)); });
}

void StepList::setStates(const StepStates& states) {
  for (std::size_t i = 0; i < kStepCount; ++i) rows_[i]->setState(states[i]);
}

void StepList::setShown(Step step) {
  StepRow* row = rows_[static_cast<std::size_t>(step)];
  row->setChecked(true);
  // Who walks the steps by keyboard goes on from here.
  if (isAncestorOf(window()->focusWidget()) || window()->focusWidget() == nullptr) row->setFocus();
}

}  // namespace gyre
