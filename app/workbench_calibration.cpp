// What the window keeps of calibrations: in use at once, and again when the same rig is connected.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <utility>

#include "app/workbench.h"
#include "core/io/calibration_record_file.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/calibration_wizard.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_words.h"
#include "ui/start_page.h"
#include "ui/work_page.h"

namespace gyre {

void Workbench::wireKeeping() {
  ResultPage* result = window_.work_page->calibration_panel->wizard->result_page;
  connect(result, &ResultPage::keepRequested, this, [this] {
    const DeviceSession& devices = controller_.devices();
    kept_file_ = settings_.keptCalibrationFile(device_id_, devices.cameraWord());
    calibrations_.save(kept_file_.toStdString());
  });
  connect(&calibrations_, &CalibrationController::saved, this, [this, result](const QString& file) {
    if (file != kept_file_) {
      result->showKept(file);
      return;
    }
    const DeviceSession& devices = controller_.devices();
    // A simulated rig knows itself: the next one of that name may be another.
    if (devices.isOpen() && !devices.rig()->room) {
      settings_.rememberCalibration(device_id_, devices.cameraWord(), file);
    }
    controller_.useCalibration(file.toStdString());
    result->showKept(QString());
  });
}

void Workbench::useCalibration(const QString& file) {
  const DeviceSession& devices = controller_.devices();
  if (controller_.useCalibration(file.toStdString()) && devices.isOpen() && !devices.rig()->room) {
    settings_.rememberCalibration(device_id_, devices.cameraWord(), file);
  }
}

void Workbench::showLastCalibration() {
  const QString file = settings_.lastCalibration();
  if (file.isEmpty()) return;
  auto record = std::make_shared<CalibrationRecord>();
  small_jobs_.start(
      [record, file](const Task&) -> Result<void> {
        auto read = readCalibrationRecord(file.toStdString());
        if (!read) return read.error();
        *record = std::move(read).value();
        return {};
      },
      [this, record](const Result<void>& read) {
        if (!read) return;  // told when it is to be used
        window_.start_page->showCalibration(calibrationText(*record, QDateTime::currentDateTime()));
      });
}

}  // namespace gyre
