// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/calibrate_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/calib/corners/point_spread.h"
#include "core/calib/lens/fit_report.h"

namespace gyre {
namespace {

struct PictureFrame {
  Eigen::Vector2i size_px;
  Eigen::Vector2d principal_px;
};

Result<PictureFrame> frameOf(std::span<const KnownPoint> points, const PointsOptions& options) {
  if (points.empty()) {
    return Error{Error::Code::kTooFew, "No points were given.",
                 "Give at least 8 points with their pixels."};
  }
  Eigen::Array2d least = points.front().pixel.array();
  Eigen::Array2d most = least;
  for (const KnownPoint& point : points) {
    least = least.min(point.pixel.array());
    most = most.max(point.pixel.array());
  }
  PictureFrame frame;
  if (options.image_size_px) {
    frame.size_px = *options.image_size_px;
    const Eigen::Array2d last = frame.size_px.cast<double>().array() - 0.5;
    if (!((least >= -0.5).all() && (most <= last).all())) {
      return Error{Error::Code::kInvalidInput, "A point lies outside of the picture.",
                   "Check the size of the image and the order of the columns X Y Z u v."};
    }
  } else {
    // Margins as wide on the right as on the left: the last pixel is the first one's mirror image.
    if (!((least >= 0.0).all() && (most < 1e6).all())) {
      return Error{Error::Code::kInvalidInput, "A pixel coordinate is not usable.",
                   "Check the order of the columns X Y Z u v, or give the size of the image."};
    }
    frame.size_px = (least + most).round().cast<int>() + 1;
  }
  frame.principal_px = options.principal_px.value_or(
      Eigen::Vector2d(0.5 * (frame.size_px.cast<double>().array() - 1.0)));
  return frame;
}

double farthestRadius(std::span<const KnownPoint> points, const Rigid3& cam_from_target) {
  double radius = 0.0;
  for (const KnownPoint& point : points) {
    const Eigen::Vector3d in_cam = cam_from_target * point.position_in_target;
    radius = std::max(radius, in_cam.hnormalized().norm());
  }
  return radius;
}

RefineOptions refineOptionsOf(PointsMode mode) {
  RefineOptions options;
  options.free_k2 = false;  // one view says little of it
  options.free_skew = mode == PointsMode::kPaper;
  return options;
}

void reportFit(std::span<const KnownPoint> points, PointsCalibration& result) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d in_cam =
        *result.calibration.cam_from_table * points[i].position_in_target;
    CalibrationResidual residual;
    residual.point = static_cast<int>(i);
    residual.pixel = points[i].pixel;
    residual.residual_px =
        points[i].pixel - result.calibration.camera.pixelFromNormalized(in_cam.hnormalized());
    result.report.residuals.push_back(residual);
  }
  result.report.views = 1;
  summarizeResiduals(result.report);
  reportSigmas(result.covariance, result.report);
}

}  // namespace

Result<PointsCalibration> calibratePoints(std::span<const KnownPoint> points,
                                          const PointsOptions& options, const Task& task) {
  const auto frame = frameOf(points, options);
  if (!frame) return frame.error();
  const bool flat = spreadOf(points).inOnePlane() && options.mode == PointsMode::kTsai;
  const auto tsai = flat ? calibrateTsaiCoplanar(points, frame->principal_px)
                         : calibrateTsai(points, frame->principal_px);
  if (!tsai) return tsai.error();

  PointsCalibration result;
  result.tsai = *tsai;
  CameraModel& camera = result.calibration.camera;
  camera = brownFromTsai(*tsai, farthestRadius(points, tsai->cam_from_target));
  camera.width_px = frame->size_px.x();
  camera.height_px = frame->size_px.y();
  result.calibration.cam_from_table = tsai->cam_from_target;
  if (options.mode != PointsMode::kTsai) {
    // The refinement's model ends at k1: begin with the first term of the inverse alone.
    camera.k1 = -tsai->kappa1;
    camera.k2 = 0.0;
    camera.k3 = 0.0;
    const std::vector<CameraView> views = {{tsai->cam_from_target, {points.begin(), points.end()}}};
    const auto refined = refineCamera(camera, views, refineOptionsOf(options.mode), task);
    if (!refined) return refined.error();
    camera = refined->camera;
    result.calibration.cam_from_table = refined->cam_from_target.front();
    result.covariance = refined->covariance;
  }
  reportFit(points, result);
  return result;
}

}  // namespace gyre
