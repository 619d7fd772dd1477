// A camera from one picture of points whose places were measured: the paper's way.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/lens/refine_camera.h"
#include "core/calib/lens/tsai.h"
#include "core/scan/calibration.h"
#include "core/scan/calibration_report.h"
#include "core/scan/known_point.h"

namespace gyre {

enum class PointsMode {
  kFull,   // Tsai, then all of f, aspect, principal point, k1 and pose by least squares
  kPaper,  // the same with the skew of the paper's camera
  kTsai    // Tsai's method alone: the principal point stays, f, tz and kappa1 are its last step
};

struct PointsOptions {
  PointsMode mode = PointsMode::kFull;
  // Width and height. Without it the picture is taken to be as large as makes the points lie in its
  // middle, with equal margins on both sides.
  std::optional<Eigen::Vector2i> image_size_px;
  // Where the principal point is to begin (kFull, kPaper) or to stay (kTsai). Without it, the
  // middle of the picture.
  std::optional<Eigen::Vector2d> principal_px;
};

struct PointsCalibration {
  // The coordinates of the points are taken for those of the table: cam_from_table is their pose.
  Calibration calibration;
  TsaiCamera tsai;  // what Tsai's method gave, before the refinement
  CameraCovariance covariance = CameraCovariance::Zero();  // zero in kTsai
  CalibrationReport report;                                // of the fit and its sigmas; no verdict
};

// Fails with a sentence on points that are too few (7; 8 leave something to judge by), in one plane
// (kTsai takes a tilted plane), on a line, mirrored, not finite, or outside of the image size.
Result<PointsCalibration> calibratePoints(std::span<const KnownPoint> points,
                                          const PointsOptions& options = {}, const Task& task = {});

}  // namespace gyre
