// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/calibration_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "core/base/units.h"
#include "core/calib/rig/object_error.h"
#include "core/geometry/turntable_pose.h"

namespace gyre::test {
namespace {

constexpr double kWorstSeed = 2.5;  // no seed may exceed a limit by more
constexpr double kFocal = 0.0005;
constexpr double kPrincipal_px = 1.0;
constexpr double kTilt_rad = radFromDeg(0.02);
constexpr double kAngles_rad = radFromDeg(0.02);
constexpr double kObject_mm = 0.01;

// Where a point comes out when its exact pixels are intersected with another calibration.
Eigen::Vector3d scannedWith(const Calibration& found, const Calibration& truth,
                            const Eigen::Vector3d& point, const std::vector<double>& angles_rad) {
  const RigFrames frames{found.camera, *found.cam_from_table, Rigid3{}};
  FacePoint estimate;
  estimate.position_in_target = point;
  for (int step = 0; step < 10; ++step) {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const double angle_rad : angles_rad) {
      const auto seen =
          truth.camera.project(camFromTable(*truth.cam_from_table, angle_rad) * point);
      RigParameters at;
      at.camera = cameraVector(found.camera);
      at.angle_rad = angle_rad;
      Eigen::Vector2d pixel;
      RigJacobian by;
      projectRig(frames, at, estimate, &pixel, &by);
      hessian += by.point_in_target.transpose() * by.point_in_target;
      gradient += by.point_in_target.transpose() * (*seen - pixel);
    }
    estimate.position_in_target += hessian.ldlt().solve(gradient);
  }
  return estimate.position_in_target;
}

std::vector<double> each(const std::vector<CalibrationMiss>& seeds,
                         double CalibrationMiss::*figure) {
  std::vector<double> values;
  values.reserve(seeds.size());
  for (const CalibrationMiss& seed : seeds) values.push_back(seed.*figure);
  return values;
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace

double objectErrorMm(const Calibration& found, const Calibration& truth) {
  const std::vector<Eigen::Vector3d> points = probePoints({});
  Eigen::VectorXd off(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    off.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        scannedWith(found, truth, points[i], probeAngles({}, points[i])) - points[i];
  }
  return std::sqrt(withoutSimilarity(points, off).rest.squaredNorm() /
                   static_cast<double>(points.size()));
}

double rmsOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

CalibrationMiss missOf(const RigCalibration& found, const Calibration& truth,
                       const std::vector<double>& true_rad) {
  const CameraModel& camera = found.calibration.camera;
  CalibrationMiss miss;
  miss.focal = std::max(std::abs(camera.fx / truth.camera.fx - 1.0),
                        std::abs(camera.fy / truth.camera.fy - 1.0));
  miss.principal_px =
      std::max(std::abs(camera.cx - truth.camera.cx), std::abs(camera.cy - truth.camera.cy));
  miss.tilt_rad = found.calibration.cam_from_table->rotation.col(2)
                      .cross(truth.cam_from_table->rotation.col(2))
                      .norm();
  std::vector<double> off;
  for (std::size_t k = 0; k < true_rad.size(); ++k) {
    off.push_back(std::remainder(found.report.angles_rad[k] - true_rad[k], kTurn_rad));
  }
  miss.angles_rad = rmsOf(off);
  miss.object_mm = objectErrorMm(found.calibration, truth);
  miss.predicted_mm = found.report.local_detail_mm;
  return miss;
}

void judgeFigures(const std::string& name, const std::vector<CalibrationMiss>& seeds) {
  const std::vector<double> focal = each(seeds, &CalibrationMiss::focal);
  const std::vector<double> principal_px = each(seeds, &CalibrationMiss::principal_px);
  const std::vector<double> tilt_rad = each(seeds, &CalibrationMiss::tilt_rad);
  const std::vector<double> angles_rad = each(seeds, &CalibrationMiss::angles_rad);
  const std::vector<double> object_mm = each(seeds, &CalibrationMiss::object_mm);
  const double ratio = rmsOf(each(seeds, &CalibrationMiss::predicted_mm)) / rmsOf(object_mm);
  std::printf(
      "%s: focal %.4f %% (worst %.4f), centre %.2f px (%.2f), tilt %.4f deg (%.4f), angles %.4f "
      "deg (%.4f), object %.4f mm (%.4f), predicted/found %.2f\n",
      name.c_str(), 100.0 * rmsOf(focal), 100.0 * most(focal), rmsOf(principal_px),
      most(principal_px), degFromRad(rmsOf(tilt_rad)), degFromRad(most(tilt_rad)),
      degFromRad(rmsOf(angles_rad)), degFromRad(most(angles_rad)), medianOf(object_mm),
      most(object_mm), ratio);
  EXPECT_LE(rmsOf(focal), kFocal);
  EXPECT_LE(most(focal), kWorstSeed * kFocal);
  EXPECT_LE(rmsOf(principal_px), kPrincipal_px);
  EXPECT_LE(most(principal_px), kWorstSeed * kPrincipal_px);
  EXPECT_LE(rmsOf(tilt_rad), kTilt_rad);
  EXPECT_LE(most(tilt_rad), kWorstSeed * kTilt_rad);
  EXPECT_LE(rmsOf(angles_rad), kAngles_rad);
  EXPECT_LE(medianOf(object_mm), kObject_mm);
  EXPECT_GE(ratio, 0.6);
  EXPECT_LE(ratio, 1.7);
}

}  // namespace gyre::test
