// Camera, axis, angles and target from the sightings of one target in all pictures of a turn.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/base/units.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/calibration.h"
#include "core/scan/calibration_record.h"
#include "core/scan/calibration_report.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

// What of the camera is solved; the rest stays as the first guess has it.
struct FreeIntrinsics {
  bool focal_length = true;
  bool aspect = true;  // fy over fx; fix it when pixels are known to be square
  bool principal_point = true;
  int radial_terms = 2;     // k1, k2, k3 in this order; 0..3
  bool tangential = false;  // p1, p2
};

enum class TargetShape {
  kExact,         // every point is where the target file puts it
  kFreeFaces,     // a fold-up target: each face a sheet with its own small turn, shift and bow
  kLooseMarkers,  // only the markers' own size is known: each lies anywhere on the table
};

// Limits of the verdict, as shares of the object's size; see CalibrationReport for the two figures.
struct VerdictLimits {
  double good_detail = 0.0005;  // 0.04 mm on 80 mm
  double good_size = 0.0015;    // 0.12 mm
  double acceptable_detail = 0.002;
  double acceptable_size = 0.006;
};

struct RigBundleOptions {
  int image_width_px = 0;   // > 0
  int image_height_px = 0;  // > 0
  FreeIntrinsics free;
  // Holds all intrinsics at these: admits flat targets and rings of markers.
  std::optional<CameraModel> fixed_camera;
  TargetShape shape = TargetShape::kFreeFaces;

  // How far a motor may stop from where its commands and the step scale put it. [rad], > 0
  double angle_prior_rad = radFromDeg(1.0);
  // How far folds are off: one standard deviation of a face's turn [rad], shift and bow [mm]; > 0
  double fold_sigma_rad = radFromDeg(1.0);
  double fold_sigma_mm = 0.5;

  // The object whose error is predicted: a ball of this diameter about this point. [mm]
  double object_size_mm = 80.0;
  Eigen::Vector3d object_middle_in_table = {0.0, 0.0, 40.0};

  // One standard deviation of a caliper's reading of a printed ruler, when somebody took one and
  // the target was scaled by it; none: size not verified. [mm], > 0
  std::optional<double> caliper_sigma_mm;
  double ruler_mm = 100.0;  // length of the printed rulers
  // What printers do to the size of a sheet: one relative standard deviation. > 0
  double printer_sigma = 0.0025;

  // A sighting further off than this is left out. [sigma], > 2
  double outlier_sigma = 4.5;
  // Less than this is refused: pictures at different angles, and the arc they cover together.
  std::size_t min_views = 6;
  double min_arc_rad = radFromDeg(90.0);
  // Half of all sightings must come nearer than this, or the pictures show something else. [px]
  double max_median_px = 2.0;
  VerdictLimits limits;

  Result<void> validate() const;
};

struct RigCalibration {
  Calibration calibration;  // table x towards the camera at angle 0, z = 0 where the target stands
  CalibrationReport report;
  Rigid3 table_from_target;
  Target target;  // as it turned out to be: folds, bows and loose markers where they truly are
  // Of camera and axis, then of the target's place, the angles and the faces; what was held fixed
  // has no entry. The axis is named by small turns and shifts of the table frame about its own x
  // and y: turns about z and shifts along it are not errors but the choice of the frame.
  std::vector<std::string> parameter_names;  // "focal_px", "axis_turn_x_rad", ...
  Eigen::MatrixXd covariance;
};

// Solves everything jointly; the first picture's angle is exactly 0. Directions and step scale are
// found, not asked; commanded angles may be missing altogether.
//
// Fails, with the remedy, on too few pictures or sightings, a target that hardly turned, one that
// lies flat on the table while the intrinsics are free, and pictures of something else. Residuals,
// outliers, verdict and all that was noticed are in the report. Deterministic; one thread.
// The equations: docs/algorithms/rig-bundle.md.
Result<RigCalibration> calibrateRig(std::span<const TargetView> views, const Target& target,
                                    const RigBundleOptions& options, const Task& task);

// All of it as a calibration file holds it; date, devices and settings are the caller's to add.
CalibrationRecord recordOf(const RigCalibration& calibration);

}  // namespace gyre
