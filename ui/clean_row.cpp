// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/clean_row.h"

#include <cmath>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

namespace gyre {
namespace {

constexpr int kSliderSteps = 400;
constexpr int kNumberWidth_px = 112;

}  // namespace

CleanRow::CleanRow(Kind kind, const CleanRowWords& words, QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);  // never squeezed
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  on_ = new QCheckBox(words.name);
  on_->setToolTip(words.tip);
  row->addWidget(on_, 1);
  connect(on_, &QCheckBox::toggled, this, [this] {
    showOn();
    Q_EMIT changed();
  });
  if (kind == Kind::kTick) return;
  number_ = new QDoubleSpinBox;
  number_->setDecimals(words.decimals);
  number_->setSuffix(words.unit);
  number_->setToolTip(words.tip);
  number_->setAccessibleName(words.name + words.unit);
  number_->setFixedWidth(kNumberWidth_px);
  number_->setGroupSeparatorShown(true);
  number_->setKeyboardTracking(false);
  row->addWidget(number_);
  connect(number_, &QDoubleSpinBox::valueChanged, this, [this](double) {
    showOn();
    if (isOn()) Q_EMIT changed();
  });
  if (kind == Kind::kNumberAndSlider) {
    slider_ = new QSlider(Qt::Horizontal);
    slider_->setRange(0, kSliderSteps);
    slider_->setToolTip(words.tip);
    slider_->setAccessibleName(words.name);
    column->addWidget(slider_);
    connect(slider_, &QSlider::valueChanged, this, [this] { number_->setValue(valueOfSlider()); });
  }
  showOn();
}

bool CleanRow::isOn() const { return on_->isChecked(); }

double CleanRow::value() const { return number_ != nullptr ? number_->value() : 0.0; }

double CleanRow::valueOfSlider() const {
  return number_->minimum() +
         (number_->maximum() - number_->minimum()) * slider_->value() / kSliderSteps;
}

void CleanRow::setRange(double least, double most, double step) {
  const QSignalBlocker quiet(number_);
  number_->setRange(least, most);
  number_->setSingleStep(step);
  showOn();
}

void CleanRow::setValue(double value) {
  const QSignalBlocker quiet(number_);
  number_->setValue(value);
  showOn();
}

void CleanRow::turnOn(double value) {
  const QSignalBlocker quiet(on_);
  on_->setChecked(true);
  if (number_ != nullptr) setValue(value);
  showOn();
}

void CleanRow::turnOff() {
  const QSignalBlocker quiet(on_);
  on_->setChecked(false);
  showOn();
}

void CleanRow::showOn() {
  if (number_ != nullptr) number_->setEnabled(isOn());
  if (slider_ == nullptr || number_ == nullptr) return;
  slider_->setVisible(isOn());
  const double span = number_->maximum() - number_->minimum();
  if (span <= 0.0) return;
  const QSignalBlocker quiet(slider_);
  slider_->setValue(
      static_cast<int>(std::lround(kSliderSteps * (number_->value() - number_->minimum()) / span)));
}

}  // namespace gyre
