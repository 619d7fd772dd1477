// How good a calibration is and what it found: facts for the user, the window and the file.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace gyre {

enum class CalibrationVerdict { kGood, kAcceptable, kRedo };

// One sighting and how far the calibrated rig misses it.
struct CalibrationResidual {
  int view = 0;   // index of the picture
  int point = 0;  // index into pointsOf(target)
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // seen minus computed
  bool used = true;                                       // false: left out as an outlier
};

// What one face of a target turned out to be.
struct FaceReport {
  double bow_mm = 0.0;     // how far its middle stands off the plane of its rim
  double tilt_rad = 0.0;   // how far its plane is turned from where the target file puts it
  double shift_mm = 0.0;   // how far its middle is off, after the rest fits
  std::size_t points = 0;  // seen on it
};

// An error of the motor that comes back with each turn: amplitude * sin(order * angle + phase).
struct TurnHarmonic {
  double amplitude_rad = 0.0;
  double phase_rad = 0.0;
};

struct CalibrationReport {
  CalibrationVerdict verdict = CalibrationVerdict::kRedo;
  std::string sentence;              // why, and what to change; one or two sentences
  std::vector<std::string> remarks;  // what else was noticed, a sentence each

  // Predicted from the covariance of the calibration, on an object of this size. [mm]
  double object_size_mm = 80.0;
  double local_detail_mm = 0.0;  // one standard deviation of its shape
  double overall_size_mm = 0.0;  // one standard deviation of its size, the target's truth included
  bool size_verified = false;    // somebody measured the target
  // Points of the target that took no part in a second solution, measured with it like an object:
  // how far off they came out, rms. Zero when that was not done. [mm]
  double check_mm = 0.0;

  double rms_px = 0.0;
  double median_px = 0.0;
  double worst_px = 0.0;
  std::size_t views = 0;
  std::size_t sightings = 0;
  std::size_t outliers = 0;

  // One standard deviation each; zero when held fixed.
  double focal_sigma_px = 0.0;
  double principal_sigma_px = 0.0;  // the larger of both directions
  double axis_tilt_sigma_rad = 0.0;
  double axis_offset_sigma_mm = 0.0;

  int direction = 1;        // -1: positive commands turn the table clockwise
  double step_scale = 1.0;  // how far the table turns over how far it was told to
  TurnHarmonic once_per_turn;
  TurnHarmonic twice_per_turn;
  std::vector<double> angles_rad;  // solved, one a picture, the first is 0
  std::vector<FaceReport> faces;   // of the target; empty when it was taken for exact
  std::vector<CalibrationResidual> residuals;
};

}  // namespace gyre
