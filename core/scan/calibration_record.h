// All that a calibration file holds: what is needed to measure, and how it came about.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"
#include "core/scan/calibration.h"
#include "core/scan/calibration_report.h"

namespace gyre {

// The turntable a calibration was made with, and what the camera found about it.
struct CalibratedTurntable {
  std::string device_id;          // stable name of the device
  std::string axis = "X";         // the letter of the firmware's axis
  double units_per_turn = 360.0;  // what the firmware counts in one turn
  int direction = 1;              // +1 when the firmware's plus is counter-clockwise from above
  double backlash_rad = 0.0;      // lost when it turns back; 0 when none was seen
  double settle_s = 0.0;          // from its arrival until nothing moves any more, with a margin

  bool operator==(const CalibratedTurntable&) const = default;
};

// How the camera was set while it was calibrated: another mode, focus or zoom voids the result.
struct CalibratedCamera {
  std::string device_id;
  std::string mode;                        // "1920x1080@MJPG"
  std::map<std::string, double> settings;  // as the driver names and counts them: focus, exposure

  bool operator==(const CalibratedCamera&) const = default;
};

// One standard deviation squared and beside it, row and column i belonging to name i.
struct NamedCovariance {
  std::vector<std::string> names;  // units end the names
  Eigen::MatrixXd matrix;          // names.size() square
};

// Everything but the calibration may be missing: other programs write only that. A calibration is
// a record of which nothing else is known.
struct CalibrationRecord {
  CalibrationRecord() = default;
  CalibrationRecord(Calibration known) : calibration(std::move(known)) {}  // implicit on purpose

  Calibration calibration;
  std::string date;    // ISO 8601, empty when nobody said
  std::string target;  // its name
  std::optional<CalibrationReport> report;
  std::optional<NamedCovariance> covariance;
  std::optional<Rigid3> table_from_target;  // where the target stood
  // Where each of pointsOf(target) turned out to be, with folds, bows and loose markers; mm. Empty
  // when nobody said.
  std::vector<Eigen::Vector3d> points_in_target;
  std::optional<CalibratedTurntable> turntable;
  std::optional<CalibratedCamera> camera;
};

}  // namespace gyre
