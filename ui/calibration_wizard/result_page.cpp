// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/result_page.h"

#include <QFileDialog>
#include <QVBoxLayout>

#include "ui/calibration_words.h"
#include "ui/parts.h"

namespace gyre {

ResultPage::ResultPage()
    : WizardPage(tr("The result"), "result",
                 tr("The arrows in the picture show how far each corner is missed.")) {
  verdict_ = makeLabel(QString(), "title");
  verdict_->setAccessibleName(tr("Verdict"));
  sentence_ = makeLabel(QString());
  figures_ = makeLabel(QString());
  remarks_ = makeLabel(QString(), "muted");
  keep_ = makePrimaryButton(tr("&Use this calibration"), tr("Scan with it from now on"));
  save_ = makeButton(tr("Save &as…"), tr("Write the calibration to a file"));
  again_ = makeButton(tr("Measure a&gain"), tr("Go back and let the table turn once more"));
  for (QWidget* part : {static_cast<QWidget*>(verdict_), static_cast<QWidget*>(sentence_),
                        static_cast<QWidget*>(figures_), static_cast<QWidget*>(remarks_),
                        static_cast<QWidget*>(keep_), static_cast<QWidget*>(save_),
                        static_cast<QWidget*>(again_)}) {
    body().addWidget(part);
  }
  body().addStretch(1);
  connect(keep_, &QPushButton::clicked, this, &ResultPage::keepRequested);
  connect(save_, &QPushButton::clicked, this, &ResultPage::askFile);
  connect(again_, &QPushButton::clicked, this, &ResultPage::againRequested);
  reset();
}

QString ResultPage::hindrance() const {
  return measured_ ? QString() : tr("Nothing has been measured yet.");
}

void ResultPage::showReport(const CalibrationReport& report, double arrow_scale) {
  measured_ = true;
  verdict_->setText(verdictText(report.verdict));
  sentence_->setText(QString::fromStdString(report.sentence));
  figures_->setText(tr("On an object of %1 mm:\nlocal detail ± %2 mm\noverall size ± %3 mm%4\n"
                       "Corners are met to %5 px (%6 of them in %7 pictures); the arrows are %8 "
                       "times as long.")
                        .arg(report.object_size_mm, 0, 'f', 0)
                        .arg(report.local_detail_mm, 0, 'f', 3)
                        .arg(report.overall_size_mm, 0, 'f', 3)
                        .arg(report.size_verified ? QString() : tr(" (size not verified)"))
                        .arg(report.rms_px, 0, 'f', 3)
                        .arg(report.sightings)
                        .arg(report.views)
                        .arg(arrow_scale, 0, 'f', 0));
  QStringList remarks;
  for (const std::string& remark : report.remarks) remarks.append(QString::fromStdString(remark));
  remarks_->setText(remarks.join('\n'));
  remarks_->setVisible(!remarks.isEmpty());
  keep_->setText(report.verdict == CalibrationVerdict::kRedo ? tr("&Use it all the same, marked")
                                                             : tr("&Use this calibration"));
  for (QPushButton* button : {keep_, save_, again_}) button->setEnabled(true);
  Q_EMIT hindranceChanged();
}

void ResultPage::showKept(const QString& where) {
  sentence_->setText(where.isEmpty() ? tr("✓ In use for the next scans.")
                                     : tr("✓ Written: %1").arg(where));
}

void ResultPage::reset() {
  measured_ = false;
  for (QLabel* label : {verdict_, sentence_, figures_, remarks_}) label->clear();
  for (QPushButton* button : {keep_, save_, again_}) button->setEnabled(false);
  Q_EMIT hindranceChanged();
}

void ResultPage::askFile() {
  const QString path = QFileDialog::getSaveFileName(
      this, tr("Save calibration"), "calibration.json", tr("Calibrations (*.json)"));
  if (!path.isEmpty()) Q_EMIT saveRequested(path);
}

}  // namespace gyre
