// One step of the clean-up: whether it is done, and its number.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QCheckBox;
class QDoubleSpinBox;
class QSlider;

namespace gyre {

// What a row says and between which numbers it moves.
struct CleanRowWords {
  QString name;
  QString unit;  // with its leading space; empty for a count
  QString tip;
  int decimals = 1;
};

// A box to tick, a number that works while it is ticked, and for what is seen in the 3D view a
// slider for the same number.
class CleanRow final : public QWidget {
  Q_OBJECT

 public:
  enum class Kind { kTick, kNumber, kNumberAndSlider };

  CleanRow(Kind kind, const CleanRowWords& words, QWidget* parent = nullptr);

  bool isOn() const;
  double value() const;  // 0 for a mere tick

  void setRange(double least, double most, double step);
  // Nothing is told of these three.
  void setValue(double value);
  void turnOn(double value);
  void turnOff();

 Q_SIGNALS:
  void changed();  // by the user: ticked, or its number while ticked

 private:
  void showOn();
  double valueOfSlider() const;

  QCheckBox* on_;
  QDoubleSpinBox* number_ = nullptr;
  QSlider* slider_ = nullptr;
};

}  // namespace gyre
