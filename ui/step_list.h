// The seven steps of a scan, each with a sign and its state in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QAbstractButton>

#include "ui/facts.h"

namespace gyre {

// One row. Painted whole, for a sign, two lines of text and the marking of the shown page.
class StepRow final : public QAbstractButton {
  Q_OBJECT

 public:
  StepRow(int number, const QString& title, QWidget* parent = nullptr);

  void setState(StepState state);
  QSize sizeHint() const override { return {240, 46}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintSign(QPainter& painter, const QRectF& circle) const;

  int number_;
  StepState state_ = StepState::kTodo;
};

class StepList final : public QWidget {
  Q_OBJECT

 public:
  explicit StepList(QWidget* parent = nullptr);

 public Q_SLOTS:
  void setStates(const gyre::StepStates& states);
  void setShown(gyre::Step step);

 Q_SIGNALS:
  void stepChosen(gyre::Step step);

 private:
  std::array<StepRow*, kStepCount> rows_{};
};

}  // namespace gyre
