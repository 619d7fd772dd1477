// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/measure_panel.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QSignalBlocker>
#include <QToolButton>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr int kRowHeight_px = 30;
constexpr int kMostRows = 4;  // of the list at once
constexpr double kMostCaliper_mm = 10000.0;

}  // namespace

MeasurePanel::MeasurePanel(QAction* measure, QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Measure"), "heading"));
  auto* button = makeButton(tr("Measure with two clicks"),
                            tr("Two clicks on the model give a length; Esc ends (M)"));
  button->setCheckable(true);
  connect(button, &QPushButton::toggled, measure, &QAction::setChecked);
  connect(measure, &QAction::toggled, button, [button](bool on) {
    button->setChecked(on);
    button->setText(on ? tr("End measuring") : tr("Measure with two clicks"));
  });
  card->addWidget(button);
  list_ = new QListWidget;
  list_->setAccessibleName(tr("Measured lengths"));
  list_->setToolTip(tr("Choose one to see its line in the model"));
  card->addWidget(list_);
  details_ = new QWidget;
  auto* details = new QVBoxLayout(details_);
  details->setContentsMargins(0, 0, 0, 0);
  words_ = makeLabel(QString(), "muted");
  details->addWidget(words_);
  auto* row = new QHBoxLayout;
  row->addWidget(makeLabel(tr("By caliper")), 1);
  caliper_mm_ = new QDoubleSpinBox;
  caliper_mm_->setRange(0.0, kMostCaliper_mm);
  caliper_mm_->setDecimals(3);
  caliper_mm_->setSuffix(tr(" mm"));
  caliper_mm_->setSpecialValueText(tr("not measured"));
  caliper_mm_->setKeyboardTracking(false);
  caliper_mm_->setAccessibleName(tr("Length by caliper in mm"));
  caliper_mm_->setToolTip(tr("What your caliper shows between the same two places, in mm"));
  row->addWidget(caliper_mm_);
  details->addLayout(row);
  difference_ = makeLabel(QString());
  details->addWidget(difference_);
  remove_ = makeButton(tr("Remove this length"), tr("Takes it out of the list"));
  details->addWidget(remove_);
  card->addWidget(details_);
  kept_ = makeLabel(QString(), "muted");
  card->addWidget(kept_);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row_number) {
    showChosen();
    Q_EMIT chosen(row_number);
  });
  connect(caliper_mm_, &QDoubleSpinBox::valueChanged, this,
          [this](double value_mm) { Q_EMIT caliperEntered(chosenRow(), value_mm); });
  connect(remove_, &QPushButton::clicked, this, [this] { Q_EMIT removeRequested(chosenRow()); });
  showMeasurements({}, -1);
}

int MeasurePanel::chosenRow() const { return list_->currentRow(); }

void MeasurePanel::showMeasurements(const std::vector<Measurement>& measurements, int chosen) {
  measurements_ = measurements;
  const QSignalBlocker quiet(list_);
  // In place: this may be the answer to a click on one of the items.
  const int count = static_cast<int>(measurements.size());
  while (list_->count() > count) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < count) list_->addItem(QString());
  for (int i = 0; i < count; ++i) {
    const Measurement& measurement = measurements[static_cast<std::size_t>(i)];
    QString text = QString::fromStdString(lengthText(measurement));
    if (measurement.caliper_mm) text += tr("  (caliper: %1)").arg(*measurement.caliper_mm);
    list_->item(i)->setText(text);
  }
  list_->setVisible(!measurements.empty());
  list_->setFixedHeight(kRowHeight_px * std::clamp(count, 1, kMostRows) + 6);
  list_->setCurrentRow(chosen);
  showChosen();
}

void MeasurePanel::showChosen() {
  const int row = chosenRow();
  const bool any = row >= 0 && static_cast<std::size_t>(row) < measurements_.size();
  details_->setVisible(any);
  if (!any) return;
  const Measurement& measurement = measurements_[static_cast<std::size_t>(row)];
  words_->setText(QString::fromStdString(uncertaintyText(measurement)));
  const QSignalBlocker quiet(caliper_mm_);
  caliper_mm_->setValue(measurement.caliper_mm.value_or(0.0));
  difference_->setText(caliperWords(measurement));
  difference_->setVisible(!difference_->text().isEmpty());
}

void MeasurePanel::showKept(const QString& words) { kept_->setText(words); }

QString caliperWords(const Measurement& measurement) {
  if (!measurement.caliper_mm) return {};
  const QString figures = QString::fromStdString(caliperText(measurement));
  const auto sigma_mm = measurement.sigmaMm();
  if (!sigma_mm || measurement.size == SizeTrust::kArbitrary) return figures;
  const double off_mm = std::abs(measurement.length_mm - *measurement.caliper_mm);
  if (off_mm <= *sigma_mm) return MeasurePanel::tr("✓ Within the ±. ") + figures;
  if (off_mm <= 2.0 * *sigma_mm) return MeasurePanel::tr("✓ Within twice the ±. ") + figures;
  return MeasurePanel::tr("⚠ Outside the ±. ") + figures;
}

}  // namespace gyre
