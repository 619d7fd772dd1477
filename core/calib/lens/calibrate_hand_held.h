// A camera's intrinsics from pictures of a target held in front of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/lens/refine_camera.h"
#include "core/scan/calibration.h"
#include "core/scan/calibration_report.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

struct HandHeldOptions {
  // p1 and p2 suit cheap lenses. A held k3 is freed when the views show for certain that the lens
  // needs it, as wide angles do. The Cauchy scale is chosen here.
  RefineOptions refine = {.free_tangential = true};
  // A sighting further off than this many robust standard deviations of all is left out. [sigma],
  // 3 .. 100
  double outlier_sigma = 4.5;
};

struct HandHeldCalibration {
  Calibration calibration;  // no cam_from_table: no table took part
  // One a view; none where fewer than six points were seen, or less than half of them fit.
  std::vector<std::optional<Rigid3>> cam_from_target;
  CameraCovariance covariance = CameraCovariance::Zero();
  CalibrationReport report;  // of the fit and its sigmas; no verdict
};

// Begins with the homographies of the target's faces (Zhang, "A Flexible New Technique for Camera
// Calibration", 2000), refines robustly, leaves out what does not fit, refines the rest plainly.
//
// Fails with a sentence when no view shows six points, when sightings name points that the target
// does not have, and when the views leave the focal length open by more than 1 %, as views of a
// flat target do that are all tilted alike.
Result<HandHeldCalibration> calibrateHandHeld(const Target& target,
                                              std::span<const TargetView> views,
                                              const Eigen::Vector2i& image_size_px,
                                              const HandHeldOptions& options = {},
                                              const Task& task = {});

}  // namespace gyre
