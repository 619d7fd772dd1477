// Step 2: what is known of camera and table, and where it comes from.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_panel.h"

#include <QFileDialog>

#include "ui/parts.h"

namespace gyre {

CalibrationPanel::CalibrationPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Calibration"), "heading"));
  source_ = makeLabel(QString());
  figures_ = makeLabel(QString(), "muted");
  card->addWidget(source_);
  card->addWidget(figures_);
  auto* open = makeButton(tr("Open calibration…"),
                          tr("Take the calibration of this camera and table from a file"));
  card->addWidget(open);
  layout->addStretch(1);
  connect(open, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Open calibration"), QString(),
                                                      tr("Calibration (*.json)"));
    if (!path.isEmpty()) Q_EMIT fileChosen(path);
  });
  showNone();
}

void CalibrationPanel::showCalibration(const Calibration& calibration, const QString& source) {
  source_->setText(source);
  const CameraModel& camera = calibration.camera;
  QString text = tr("Pictures of %1 × %2 px, focal length %3 px")
                     .arg(camera.width_px)
                     .arg(camera.height_px)
                     .arg(camera.fx, 0, 'f', 1);
  text += calibration.cam_from_table
              ? tr("\nCamera %1 mm from the middle of the table")
                    .arg(calibration.cam_from_table->translation.norm(), 0, 'f', 1)
              : tr("\nThe place of the camera at the table is not known: this calibration cannot "
                   "be used for a scan.");
  figures_->setText(text);
}

void CalibrationPanel::showNone() {
  source_->setText(tr("None yet."));
  figures_->setText(
      tr("A scan needs to know the camera and its place at the table. The simulated "
         "rig brings its own calibration."));
}

}  // namespace gyre
