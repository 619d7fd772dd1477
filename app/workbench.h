// Wires the window's wishes to the scan controller, and its facts to the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include "app/calibration_controller.h"
#include "app/doctor.h"
#include "app/job_runner.h"
#include "app/measure_controller.h"
#include "app/person_at_window.h"
#include "app/scan_controller.h"
#include "app/settings.h"
#include "core/scan/picture_size.h"
#include "ui/main_window.h"

namespace gyre {

// One window with all that works behind it. GUI thread only.
class Workbench final : public QObject {
  Q_OBJECT

 public:
  explicit Workbench(const RigOptions& rig);

  MainWindow& window() { return window_; }
  ScanController& controller() { return controller_; }
  MeasureController& measures() { return measures_; }
  CalibrationController& calibrations() { return calibrations_; }
  Doctor& doctor() { return doctor_; }
  PersonAtWindow& person() { return person_; }

  // A whole scan on the simulated rig: connects, looks at the empty table, scans.
  void runDemo(const QString& object, int views, const QString& folder);
  void open(const QString& path);

 private:
  void wireStart();
  void closeWhenQuiet();
  void wireDevices();
  void wireDoctor();
  static RigOptions withPerson(RigOptions rig, PersonAtWindow& person);
  void wirePerson();
  void offerMarks(double marks);
  void showViewsRemark();
  void wireKeeping();
  void wireScan();
  void wireResults();
  void wireFacts();
  void listDevices();
  void askWhenLocked(const Error& error);
  void devicesOpened(const TurntableInfo& turntable, const CameraInfo& camera);
  void useCalibration(const QString& file);
  void showLastCalibration();
  void newScan();
  void startScan();
  void showSteps();
  void showCost();
  void rememberScan();

  Settings settings_;
  MainWindow window_;
  PersonAtWindow person_;  // outlives the tables that ask through it
  ScanController controller_;
  CalibrationController calibrations_;
  MeasureController measures_;
  Doctor doctor_;
  JobRunner small_jobs_;  // lists devices, writes thumbnails
  QString device_id_;
  double steps_per_turn_ = 0.0;  // of the table that is open
  PictureSize picture_size_;     // of the camera that is open
  QString kept_file_;            // of the calibration in use
  QString title_;
  bool locked_ = false;  // the camera, since it was opened
  bool placed_ = false;
  bool quiet_ = false;  // nothing of the scan goes on, and the window was told to close
  bool demo_ = false;   // the demo goes on by itself until its scan has started
};

}  // namespace gyre
