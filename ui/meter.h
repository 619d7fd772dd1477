// A bar that shows how much, with a word beside it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace gyre {

enum class MeterState { kGood, kWarning, kBad };

// The word says what the colour says, so that neither is needed.
class Meter final : public QWidget {
  Q_OBJECT

 public:
  explicit Meter(const QString& name, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {240, 38}; }
  MeterState state() const { return state_; }

 public Q_SLOTS:
  // share in [0, 1].
  void show(double share, gyre::MeterState state, const QString& word);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString name_;
  QString word_;
  double share_ = 0.0;
  MeterState state_ = MeterState::kWarning;
};

}  // namespace gyre
