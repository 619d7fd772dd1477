// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/target_page.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/parts.h"

namespace gyre {
namespace {

constexpr double kRuler_mm = 100.0;
constexpr double kNotMeasured = 0.0;

QDoubleSpinBox* makeReading(const QString& name) {
  auto* reading = new QDoubleSpinBox;
  reading->setRange(kNotMeasured, 2.0 * kRuler_mm);
  reading->setDecimals(2);
  reading->setSingleStep(0.05);
  reading->setSuffix(TargetPage::tr(" mm"));
  reading->setSpecialValueText(TargetPage::tr("not measured"));
  reading->setAccessibleName(name);
  return reading;
}

std::optional<double> readingOf(const QDoubleSpinBox& box) {
  if (box.value() <= kNotMeasured) return std::nullopt;
  return box.value();
}

}  // namespace

TargetPage::TargetPage()
    : WizardPage(tr("Choose the target"), "target",
                 tr("Print it at 100 %, fold and glue it, and measure its two rulers with a "
                    "caliper. Without the caliper the size stays unverified.")) {
  target_ = new QComboBox;
  target_->setAccessibleName(tr("Target"));
  about_ = makeLabel(QString(), "muted");
  page_ = new QComboBox;
  page_->addItem("A4", "a4");
  page_->addItem("Letter", "letter");
  page_->setAccessibleName(tr("Paper"));
  auto* print = makeButton(tr("&Print…"), tr("Write the target as a PDF of true size"));
  auto* own = makeButton(tr("Own target…"), tr("Use the description of a target of your own"));
  right_mm_ = makeReading(tr("Ruler along the width of the page"));
  down_mm_ = makeReading(tr("Ruler along the height of the page"));
  state_ = makeLabel(QString(), "muted");
  auto* row = new QHBoxLayout;
  row->addWidget(page_);
  row->addWidget(print, 1);
  auto* readings = new QFormLayout;
  readings->addRow(tr("Ruler →"), right_mm_);
  readings->addRow(tr("Ruler ↓"), down_mm_);
  body().addWidget(target_);
  body().addWidget(about_);
  body().addLayout(row);
  body().addWidget(own);
  body().addLayout(readings);
  keep_lens_ = new QCheckBox(tr("Only the camera was moved: &keep its lens"));
  keep_lens_->setToolTip(
      tr("Measures the camera's place anew and keeps focal length and distortion of the "
         "calibration in use. Neither focus nor zoom may have been touched; a flat target or the "
         "ring will do."));
  keep_lens_->setEnabled(false);
  body().addWidget(keep_lens_);
  body().addWidget(state_);
  body().addStretch(1);
  hindrance_ = tr("Choose a target first.");
  connect(target_, &QComboBox::activated, this, &TargetPage::announce);
  connect(right_mm_, &QDoubleSpinBox::editingFinished, this, &TargetPage::announce);
  connect(down_mm_, &QDoubleSpinBox::editingFinished, this, &TargetPage::announce);
  connect(keep_lens_, &QCheckBox::toggled, this, &TargetPage::announce);
  connect(print, &QPushButton::clicked, this, &TargetPage::askFolder);
  connect(own, &QPushButton::clicked, this, &TargetPage::askFile);
}

TargetChoice TargetPage::choice() const {
  return {target_->currentData().toString(), readingOf(*right_mm_), readingOf(*down_mm_),
          keep_lens_->isChecked()};
}

void TargetPage::showOffers(const std::vector<TargetOffer>& offers) {
  offers_ = offers;
  target_->clear();
  for (const TargetOffer& offer : offers) target_->addItem(offer.title, offer.word);
  announce();
}

void TargetPage::showReady() {
  hindrance_.clear();
  const bool measured = readingOf(*right_mm_) && readingOf(*down_mm_);
  state_->setText(measured ? tr("✓ Size verified by the caliper")
                           : tr("△ Size not verified: the verdict is at best “acceptable”"));
  Q_EMIT hindranceChanged();
}

void TargetPage::showProblem(const Error& why) {
  hindrance_ = QString::fromStdString(why.sentence());
  state_->setText(tr("✗ This target cannot be used"));
  Q_EMIT hindranceChanged();
}

void TargetPage::allowKeepingLens() { keep_lens_->setEnabled(true); }

void TargetPage::showPrinted(const QString& file) {
  state_->setText(tr("✓ Written: %1").arg(QDir::toNativeSeparators(file)));
}

void TargetPage::useFile(const QString& path) {
  target_->addItem(QFileInfo(path).fileName(), path);
  target_->setCurrentIndex(target_->count() - 1);
  announce();
}

void TargetPage::askFile() {
  const QString path =
      QFileDialog::getOpenFileName(this, tr("Open target"), QString(), tr("Targets (*.json)"));
  if (!path.isEmpty()) useFile(path);
}

void TargetPage::askFolder() {
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the PDF"));
  if (folder.isEmpty()) return;
  Q_EMIT printRequested(choice().word, page_->currentData().toString(), folder);
}

void TargetPage::announce() {
  const QString word = choice().word;
  const auto offer = std::find_if(offers_.begin(), offers_.end(),
                                  [&](const TargetOffer& known) { return known.word == word; });
  about_->setText(offer == offers_.end() ? tr("A target of your own") : offer->about);
  hindrance_ = tr("The target is being read.");
  Q_EMIT hindranceChanged();
  if (!word.isEmpty()) Q_EMIT targetChosen(choice());
}

}  // namespace gyre
