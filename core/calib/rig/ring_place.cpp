// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/ring_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "core/base/check.h"
#include "core/base/median.h"
#include "core/base/units.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastSightings = 8;
constexpr int kNewtonSteps = 8;
constexpr double kOutlierMedians = 6.0;
constexpr double kLeastSpread_px = 0.05;  // no corner is found better than this
constexpr int kSpin = 2;                  // of the six freedoms: about the table's axis
constexpr double kFreedomsBesideSpin = 5.0;

using MotionJacobian = Eigen::Matrix<double, 2, 6>;  // by rotation and shift in the base frame
using Motion = Eigen::Matrix<double, 6, 1>;

struct Look {
  Eigen::Vector2d pixel;
  Eigen::Vector3d point_in_table;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  // seen less predicted
  MotionJacobian by = MotionJacobian::Zero();
};

// The angle at which most sightings have their points: each meets the platter at an azimuth.
std::optional<double> roughAngle(const Calibration& calibration, const std::vector<Look>& looks) {
  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  std::vector<double> turned_rad;
  turned_rad.reserve(looks.size());
  for (const Look& look : looks) {
    const Ray ray{base_from_cam.translation,
                  base_from_cam.rotation * calibration.camera.rayInCam(look.pixel)};
    const auto at = meetHorizontalPlane(ray, look.point_in_table.z());
    if (!at) continue;
    turned_rad.push_back(std::atan2(at->y(), at->x()) -
                         std::atan2(look.point_in_table.y(), look.point_in_table.x()));
  }
  if (turned_rad.size() < kLeastSightings) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const double angle : turned_rad) mean += Eigen::Vector2d(std::cos(angle), std::sin(angle));
  const double about_rad = std::atan2(mean.y(), mean.x());
  for (double& angle : turned_rad) {
    angle = std::remainder(angle - about_rad, kTurn_rad);
  }
  return about_rad + median(std::move(turned_rad));
}

// Residual and derivatives of one sighting with the table at an angle; false when the point is not
// in front of the camera.
bool predict(const Calibration& calibration, double angle_rad, Look& look) {
  const Eigen::Vector3d in_base = baseFromTable(angle_rad) * look.point_in_table;
  const Eigen::Vector3d in_cam = *calibration.cam_from_table * in_base;
  const auto pixel = calibration.camera.project(in_cam);
  if (!pixel) return false;
  look.residual = look.pixel - *pixel;
  const Eigen::Vector2d normalized = in_cam.head<2>() / in_cam.z();
  Eigen::Matrix<double, 2, 3> by_cam;
  by_cam << Eigen::Matrix2d::Identity(), -normalized;
  const Eigen::Matrix<double, 2, 3> by_base = calibration.camera.pixelJacobian(normalized) *
                                              by_cam / in_cam.z() *
                                              calibration.cam_from_table->rotation;
  for (int axis = 0; axis < 3; ++axis) {
    look.by.col(axis) = by_base * Eigen::Vector3d::Unit(axis).cross(in_base);
  }
  look.by.rightCols<3>() = by_base;
  return true;
}

void leaveOutliers(std::vector<Look>& looks) {
  std::vector<double> off_px;
  off_px.reserve(looks.size());
  for (const Look& look : looks) off_px.push_back(look.residual.norm());
  const double most_px = kOutlierMedians * std::max(median(std::move(off_px)), kLeastSpread_px);
  std::erase_if(looks, [&](const Look& look) { return look.residual.norm() > most_px; });
}

// Turns the table until the sightings fit best; false when too few are left.
bool turnToFit(const Calibration& calibration, std::vector<Look>& looks, double& angle_rad) {
  for (int step = 0; step < kNewtonSteps; ++step) {
    std::erase_if(looks, [&](Look& look) { return !predict(calibration, angle_rad, look); });
    if (step == kNewtonSteps / 2) leaveOutliers(looks);
    if (looks.size() < kLeastSightings) return false;
    double curvature = 0.0;
    double slope = 0.0;
    for (const Look& look : looks) {
      curvature += look.by.col(kSpin).squaredNorm();
      slope += look.by.col(kSpin).dot(look.residual);
    }
    if (!(curvature > 0.0)) return false;
    angle_rad += slope / curvature;
  }
  for (Look& look : looks) static_cast<void>(predict(calibration, angle_rad, look));
  return true;
}

}  // namespace

std::optional<RingPlace> placeOfRing(const Calibration& calibration,
                                     std::span<const Eigen::Vector3d> points_in_table,
                                     const TargetView& view) {
  GYRE_CHECK(calibration.cam_from_table.has_value());
  std::vector<Look> looks;
  looks.reserve(view.sightings.size());
  for (const PointSighting& seen : view.sightings) {
    GYRE_CHECK(seen.point >= 0 && static_cast<std::size_t>(seen.point) < points_in_table.size());
    looks.push_back({seen.pixel, points_in_table[static_cast<std::size_t>(seen.point)]});
  }
  if (looks.size() < kLeastSightings) return std::nullopt;
  auto angle_rad = roughAngle(calibration, looks);
  if (!angle_rad || !turnToFit(calibration, looks, *angle_rad)) return std::nullopt;

  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  Motion gradient = Motion::Zero();
  for (const Look& look : looks) {
    hessian += look.by.transpose() * look.by;
    gradient += look.by.transpose() * look.residual;
  }
  const Motion motion = hessian.ldlt().solve(gradient);
  const double spin = hessian.row(kSpin).dot(motion) / hessian(kSpin, kSpin);
  double noise = 0.0;
  double moved = 0.0;
  for (const Look& look : looks) {
    const Eigen::Vector2d explained = look.by * motion;
    noise += (look.residual - explained).squaredNorm();
    moved += (explained - spin * look.by.col(kSpin)).squaredNorm();
  }
  const auto count = static_cast<double>(looks.size());
  const double spread_px =
      std::max(std::sqrt(noise / (2.0 * count - 6.0)), kLeastSpread_px / std::sqrt(2.0));
  RingPlace place;
  place.angle_rad = std::remainder(*angle_rad, kTurn_rad);
  place.sigma_rad = spread_px / std::sqrt(hessian(kSpin, kSpin));
  place.px = std::sqrt(moved / count);
  place.sigma_px = spread_px * std::sqrt(kFreedomsBesideSpin / count);
  place.sightings = looks.size();
  return place;
}

}  // namespace gyre
