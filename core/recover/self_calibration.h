// A better camera and axis from the object's own tracks.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/base/units.h"
#include "core/scan/calibration.h"
#include "core/scan/track.h"

namespace gyre {

// A point that is roughly known, and where it was seen.
struct PixelTrack {
  std::vector<Observation> observations;
  Eigen::Vector3d position_in_table = Eigen::Vector3d::Zero();  // mm
};

// Where the table stood, one entry a view. [rad]
struct ViewAngles {
  std::vector<double> told_rad;
  std::vector<double> start_rad;  // where it is believed to have stood
};

// What is known beforehand, as standard deviations.
struct SelfCalibrationOptions {
  double focal_share = 0.02;           // of the focal length, as a share of it. > 0
  double k1 = 0.1;                     // of the first coefficient of distortion. > 0
  double centre_px = 10.0;             // of either coordinate of the principal point. > 0
  double angle_rad = radFromDeg(0.1);  // of each angle. > 0
  int most_steps = 50;                 // of the solver
};

struct SelfCalibration {
  Calibration calibration;
  std::vector<double> angles_rad;  // one a view; the one told nearest 0 as told
  double focal_sigma_px = 0.0;     // standard deviation of the focal length
  double rms_before_px = 0.0;      // of the sightings that agree: within 3 sigma at the end
  double rms_after_px = 0.0;
};

// Turns the camera where it stands, and changes its focal length, its first coefficient of
// distortion and its principal point, the table's angles and all points until the sightings agree
// best, robustly (Cauchy). The camera's place over the table stays: turned about the axis, along
// it, or at another distance from it, the same pictures show, but for the size of the object. So
// the size is as good as the distance is known, and as the focal length is told by perspective.
//
// kTooFew with fewer than 50 tracks, kCancelled when stopped, kInternal when the solver gives up.
// Triggs et al., "Bundle adjustment - a modern synthesis" (2000).
Result<SelfCalibration> selfCalibrate(std::span<const PixelTrack> tracks,
                                      const Calibration& calibration, const ViewAngles& angles,
                                      const SelfCalibrationOptions& options, const Task& task);

}  // namespace gyre
