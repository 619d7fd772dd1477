// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/search_volume.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kAround = 72;
constexpr int kRadii = 60;
constexpr int kHeights = 60;
// Nothing is expected nearer to the camera than this share of its distance from the axis.
constexpr double kReach = 0.8;

bool seesCircle(const CameraModel& camera, const Rigid3& cam_from_table, double radius_mm,
                double z_mm) {
  for (int i = 0; i < kAround; ++i) {
    const double azimuth = kTurn_rad * i / kAround;
    const Eigen::Vector3d point(radius_mm * std::cos(azimuth), radius_mm * std::sin(azimuth), z_mm);
    const auto pixel = camera.project(cam_from_table * point);
    if (pixel && camera.contains(*pixel)) return true;
  }
  return false;
}

}  // namespace

SearchVolume visibleVolume(const CameraModel& camera, const Rigid3& cam_from_table) {
  const Eigen::Vector3d centre = cam_from_table.inverse().translation;
  const double far_mm = kReach * std::max(centre.head<2>().norm(), 0.5 * centre.norm());
  SearchVolume volume{0.0, -2.0, 0.0};
  for (int h = 0; h <= kHeights; ++h) {
    const double z_mm = 2.0 * far_mm * h / kHeights;
    for (int r = kRadii; r >= 0; --r) {
      const double radius_mm = far_mm * r / kRadii;
      if (!seesCircle(camera, cam_from_table, radius_mm, z_mm)) continue;
      volume.radius_mm = std::max(volume.radius_mm, radius_mm);
      volume.z_max_mm = std::max(volume.z_max_mm, z_mm);
      break;
    }
  }
  volume.radius_mm += far_mm / kRadii;
  volume.z_max_mm += 2.0 * far_mm / kHeights;
  return volume;
}

}  // namespace gyre
