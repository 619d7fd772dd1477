// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/usable_cylinder.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kCorners = 72;
constexpr double kMarginShare = 0.01;  // of the picture's width
constexpr int kHeights = 100;
constexpr int kHalvings = 12;  // a thousandth of the camera's distance and less

// The largest circle at this height. The sight is convex, so smaller ones stay in it too. [mm]
double largestRadius(const CameraModel& camera, const Rigid3& cam_from_table, double far_mm,
                     double height_mm) {
  if (!circleStaysInPicture(camera, cam_from_table, 0.0, height_mm)) return 0.0;
  double in_mm = 0.0;
  double out_mm = far_mm;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_mm = 0.5 * (in_mm + out_mm);
    const bool stays = circleStaysInPicture(camera, cam_from_table, middle_mm, height_mm);
    (stays ? in_mm : out_mm) = middle_mm;
  }
  return in_mm;
}

}  // namespace

bool circleStaysInPicture(const CameraModel& camera, const Rigid3& cam_from_table, double radius_mm,
                          double height_mm) {
  const double margin_px = kMarginShare * camera.width_px;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = kTurn_rad * i / kCorners;
    const Eigen::Vector3d in_table(radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad),
                                   height_mm);
    const auto pixel = camera.project(cam_from_table * in_table);
    if (!pixel || !camera.contains(*pixel, margin_px)) return false;
  }
  return true;
}

std::vector<PictureLine> drawnInPicture(const UsableCylinder& cylinder, const CameraModel& camera,
                                        const Rigid3& cam_from_table) {
  std::vector<PictureLine> lines;
  const auto add = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const auto a = camera.project(cam_from_table * from);
    const auto b = camera.project(cam_from_table * to);
    if (a && b) lines.push_back({*a, *b});
  };
  const auto rim = [&](int corner, double height_mm) {
    const double angle_rad = kTurn_rad * corner / kCorners;
    return Eigen::Vector3d(cylinder.radius_mm * std::cos(angle_rad),
                           cylinder.radius_mm * std::sin(angle_rad), height_mm);
  };
  for (const double height_mm : {0.0, cylinder.height_mm}) {
    for (int i = 0; i < kCorners; ++i) add(rim(i, height_mm), rim(i + 1, height_mm));
  }
  add(Eigen::Vector3d::Zero(), {0.0, 0.0, cylinder.height_mm});
  return lines;
}

std::optional<UsableCylinder> usableCylinder(const CameraModel& camera,
                                             const Rigid3& cam_from_table) {
  const double far_mm = cam_from_table.inverse().translation.norm();
  UsableCylinder best;
  double most = 0.0;
  double radius_mm = far_mm;
  for (int h = 0; h <= kHeights; ++h) {
    const double height_mm = far_mm * h / kHeights;
    radius_mm = std::min(radius_mm, largestRadius(camera, cam_from_table, far_mm, height_mm));
    if (radius_mm <= 0.0) break;
    const double volume = radius_mm * radius_mm * height_mm;
    if (volume > most) {
      most = volume;
      best = {radius_mm, height_mm};
    }
  }
  if (most <= 0.0) return std::nullopt;
  return best;
}

}  // namespace gyre
