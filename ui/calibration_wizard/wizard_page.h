// One page of the calibration wizard: a picture, one thing to do, and whether it is done.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QVBoxLayout;

namespace gyre {

class WizardPage : public QWidget {
  Q_OBJECT

 public:
  // Why one cannot go on from here, in a sentence; empty when one can.
  virtual QString hindrance() const = 0;
  const QString& title() const { return title_; }

 Q_SIGNALS:
  void hindranceChanged();

 protected:
  // picture: an SVG of resources/wizard, without ending. instruction: the one thing to do.
  WizardPage(const QString& title, const QString& picture, const QString& instruction);

  QVBoxLayout& body() { return *body_; }

 private:
  QString title_;
  QVBoxLayout* body_ = nullptr;
};

}  // namespace gyre
