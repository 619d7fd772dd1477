// Step 3: what is known of camera and table, where it comes from, and the way to measure it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_panel.h"

#include <QFileDialog>
#include <QStackedWidget>

#include "ui/calibration_wizard/calibration_wizard.h"
#include "ui/calibration_words.h"
#include "ui/parts.h"

namespace gyre {

CalibrationPanel::CalibrationPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  stack_ = new QStackedWidget;
  layout->addWidget(stack_);
  stack_->addWidget(buildOverview());
  wizard = new CalibrationWizard;
  stack_->addWidget(wizard);
  connect(wizard, &CalibrationWizard::leaveRequested, this, &CalibrationPanel::showOverview);
  showNone();
  forbidMeasuring(tr("Connect turntable and camera first (step 1)."));
}

QWidget* CalibrationPanel::buildOverview() {
  auto* overview = new QWidget;
  auto* layout = new QVBoxLayout(overview);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Calibration"), "heading"));
  source_ = makeLabel(QString());
  figures_ = makeLabel(QString(), "muted");
  quality_ = makeLabel(QString());
  card->addWidget(source_);
  card->addWidget(figures_);
  card->addWidget(quality_);
  measure_ = makePrimaryButton(tr("Calibrate"),
                               tr("Measure camera and table with a printed target, in four pages"));
  hindrance_ = makeLabel(QString(), "muted");
  card->addWidget(measure_);
  card->addWidget(hindrance_);
  auto* open = makeButton(tr("Open calibration…"),
                          tr("Take the calibration of this camera and table from a file"));
  card->addWidget(open);
  layout->addStretch(1);
  connect(measure_, &QPushButton::clicked, this, &CalibrationPanel::showWizard);
  connect(open, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Open calibration"), QString(),
                                                      tr("Calibration (*.json)"));
    if (!path.isEmpty()) Q_EMIT fileChosen(path);
  });
  return overview;
}

bool CalibrationPanel::showsWizard() const { return stack_->currentWidget() == wizard; }

void CalibrationPanel::showCalibration(const CalibrationRecord& record, const QString& source) {
  source_->setText(source);
  const CameraModel& camera = record.calibration.camera;
  const std::optional<Rigid3>& cam_from_table = record.calibration.cam_from_table;
  QString text = tr("Pictures of %1 × %2 px, focal length %3 px")
                     .arg(camera.width_px)
                     .arg(camera.height_px)
                     .arg(camera.fx, 0, 'f', 1);
  text += cam_from_table ? tr("\nCamera %1 mm from the middle of the table")
                               .arg(cam_from_table->translation.norm(), 0, 'f', 1)
                         : tr("\nThe place of the camera at the table is not known: this "
                              "calibration cannot be used for a scan.");
  figures_->setText(text);
  quality_->setText(calibrationText(record, QDateTime::currentDateTime()));
  quality_->setVisible(!quality_->text().isEmpty());
}

void CalibrationPanel::showNone() {
  source_->setText(tr("None yet."));
  figures_->setText(
      tr("A scan needs to know the camera and its place at the table. The simulated "
         "rig brings its own calibration."));
  quality_->hide();
}

void CalibrationPanel::allowMeasuring() {
  measure_->setEnabled(true);
  hindrance_->hide();
}

void CalibrationPanel::forbidMeasuring(const QString& why) {
  measure_->setEnabled(false);
  hindrance_->setText(why);
  hindrance_->show();
}

void CalibrationPanel::showWizard() {
  stack_->setCurrentWidget(wizard);
  measure_->setText(tr("Go on calibrating"));
  Q_EMIT wizardShown(true);
}

void CalibrationPanel::showOverview() {
  if (!showsWizard()) return;
  stack_->setCurrentIndex(0);
  Q_EMIT wizardShown(false);
}

}  // namespace gyre
