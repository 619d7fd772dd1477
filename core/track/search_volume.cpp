// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/search_volume.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr int kRadii = 100;
constexpr int kHeights = 100;
// Nothing is expected nearer to the camera than this share of its distance from the axis.
constexpr double kReach = 0.8;

}  // namespace

SearchVolume visibleVolume(const CameraModel& camera, const Rigid3& cam_from_table) {
  const Eigen::Vector3d centre = cam_from_table.inverse().translation;
  const Eigen::Vector3d towards = Eigen::Vector3d(centre.x(), centre.y(), 0.0).normalized();
  const Eigen::Vector3d aside = Eigen::Vector3d::UnitZ().cross(towards);
  const double far_mm = kReach * std::max(centre.head<2>().norm(), 0.5 * centre.norm());
  // A point turning at radius r passes the outline at r to either side of the axis: beyond the
  // picture's edge there, it leaves the picture in every turn.
  const auto sees = [&](const Eigen::Vector3d& point_in_table) {
    const auto pixel = camera.project(cam_from_table * point_in_table);
    return pixel && camera.contains(*pixel);
  };
  SearchVolume volume{0.0, -2.0, 0.0};
  for (int h = 0; h <= kHeights; ++h) {
    const Eigen::Vector3d on_axis(0.0, 0.0, 2.0 * far_mm * h / kHeights);
    for (int r = kRadii; r >= 0; --r) {
      const double radius_mm = far_mm * r / kRadii;
      if (!sees(on_axis + radius_mm * aside) && !sees(on_axis - radius_mm * aside)) continue;
      volume.radius_mm = std::max(volume.radius_mm, radius_mm);
      volume.z_max_mm = std::max(volume.z_max_mm, on_axis.z());
      break;
    }
  }
  volume.radius_mm += far_mm / kRadii;
  volume.z_max_mm += 2.0 * far_mm / kHeights;
  return volume;
}

}  // namespace gyre
