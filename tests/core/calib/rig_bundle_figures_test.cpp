// The judged figures of the rig bundle: ten seeds of ideal sightings on the default rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <Eigen/Dense>

#include "core/calib/object_error.h"
#include "core/calib/rig_bundle.h"
#include "core/calib/standard_targets.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/rig.h"
#include "tests/support/turned_target.h"

namespace gyre {
namespace {

constexpr int kSeeds = 10;
constexpr double kWorstSeed = 2.5;  // no seed may exceed a limit by more
constexpr double kFocal = 0.0005;
constexpr double kPrincipal_px = 1.0;
constexpr double kTilt_rad = radFromDeg(0.02);

// The ones people print.
std::vector<Target> printedTargets() {
  return {standardTarget("wedge").value().target, standardTarget("coded-cube").value().target};
}

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

// rms distance on the object, after the best similarity.
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

struct Figures {
  std::vector<double> focal;
  std::vector<double> principal_px;
  std::vector<double> tilt_rad;
  std::vector<double> angles_rad;
  std::vector<double> object_mm;
  std::vector<double> predicted_mm;
};

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

void addSeed(const test::TurnedTarget& turned, std::uint64_t seed, Figures& figures) {
  RigBundleOptions options;
  options.image_width_px = 1280;
  options.image_height_px = 960;
  const auto found = calibrateRig(turned.views(seed), turned.target, options, Task{});
  ASSERT_TRUE(found) << found.error().sentence();
  const CameraModel& camera = found->calibration.camera;
  const CameraModel& truth = turned.truth.camera;
  figures.focal.push_back(
      std::max(std::abs(camera.fx / truth.fx - 1.0), std::abs(camera.fy / truth.fy - 1.0)));
  figures.principal_px.push_back(
      std::max(std::abs(camera.cx - truth.cx), std::abs(camera.cy - truth.cy)));
  figures.tilt_rad.push_back(found->calibration.cam_from_table->rotation.col(2)
                                 .cross(turned.truth.cam_from_table->rotation.col(2))
                                 .norm());
  std::vector<double> off;
  for (std::size_t k = 0; k < turned.true_rad.size(); ++k) {
    off.push_back(found->report.angles_rad[k] - turned.true_rad[k]);
  }
  figures.angles_rad.push_back(rms(off));
  figures.object_mm.push_back(objectErrorMm(found->calibration, turned.truth));
  figures.predicted_mm.push_back(found->report.local_detail_mm);
}

void judgeFigures(const char* name, Figures& figures) {
  std::nth_element(figures.object_mm.begin(), figures.object_mm.begin() + kSeeds / 2,
                   figures.object_mm.end());
  const double median_mm = figures.object_mm[kSeeds / 2];
  const double ratio = rms(figures.predicted_mm) / rms(figures.object_mm);
  std::printf(
      "%s: focal %.4f %% (worst %.4f), centre %.2f px (%.2f), tilt %.4f deg (%.4f), angles %.4f "
      "deg, object %.4f mm, predicted/found %.2f\n",
      name, 100.0 * rms(figures.focal), 100.0 * most(figures.focal), rms(figures.principal_px),
      most(figures.principal_px), degFromRad(rms(figures.tilt_rad)),
      degFromRad(most(figures.tilt_rad)), degFromRad(rms(figures.angles_rad)), median_mm, ratio);
  EXPECT_LE(rms(figures.focal), kFocal);
  EXPECT_LE(most(figures.focal), kWorstSeed * kFocal);
  EXPECT_LE(rms(figures.principal_px), kPrincipal_px);
  EXPECT_LE(most(figures.principal_px), kWorstSeed * kPrincipal_px);
  EXPECT_LE(rms(figures.tilt_rad), kTilt_rad);
  EXPECT_LE(most(figures.tilt_rad), kWorstSeed * kTilt_rad);
  EXPECT_LE(median_mm, 0.01);
  EXPECT_LE(rms(figures.angles_rad), radFromDeg(0.02));
  EXPECT_GE(ratio, 0.7);
  EXPECT_LE(ratio, 1.4);
}

TEST(RigBundleFigures, HoldOnWedgeAndCube) {
  for (const Target& target : printedTargets()) {
    Figures figures;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      addSeed(test::TurnedTarget(target), static_cast<std::uint64_t>(seed), figures);
    }
    judgeFigures(target.name.c_str(), figures);
  }
}

TEST(RigBundleFigures, HoldWithAPoorMotor) {
  for (const Target& target : printedTargets()) {
    Figures figures;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      test::TurnedTarget turned(target);
      RigSettings rig;
      rig.seed = seed;
      rig.step_scale_error = 0.01;
      rig.once_per_turn_error_deg = 0.3;
      rig.white_error_deg = 0.05;
      for (std::size_t k = 0; k < turned.true_rad.size(); ++k) {
        turned.true_rad[k] = trueAngleRad(
            rig, std::lround(turned.commanded_rad[k] / kTurn_rad * rig.steps_per_turn));
      }
      addSeed(turned, static_cast<std::uint64_t>(seed), figures);
    }
    judgeFigures((target.name + ", poor motor").c_str(), figures);
  }
}

}  // namespace
}  // namespace gyre
