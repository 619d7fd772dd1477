// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/turning_cylinder.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"

namespace gyre::test {
namespace {

enum class Contents { kCylinder, kNothing };

double lattice(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  const std::uint64_t hash =
      hashWords({static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), seed});
  return static_cast<double>(hash >> 11U) * 0x1.0p-52 - 1.0;
}

double smoothNoise(double x, double y, std::uint64_t seed) {
  const double column = std::floor(x);
  const double row = std::floor(y);
  const auto ease = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
  const double u = ease(x - column);
  const double v = ease(y - row);
  const auto i = static_cast<std::int64_t>(column);
  const auto j = static_cast<std::int64_t>(row);
  const double top = std::lerp(lattice(i, j, seed), lattice(i + 1, j, seed), u);
  const double bottom = std::lerp(lattice(i, j + 1, seed), lattice(i + 1, j + 1, seed), u);
  return std::lerp(top, bottom, v);
}

// Brightness of what the ray from the camera meets, in the table frame. [0, 255]
double shade(const TurningCylinder& world, const Ray& ray_in_table, const Ray& ray_in_base,
             Contents contents) {
  if (contents == Contents::kCylinder) {
    const auto span = crossCylinder(ray_in_table, world.radius_mm, 0.0, world.height_mm);
    if (span && span->from > 0.0) {
      const Eigen::Vector3d x = ray_in_table.origin + span->from * ray_in_table.direction;
      const double across = x.z() > world.height_mm - 1e-6
                                ? x.x()
                                : std::atan2(x.y(), x.x()) * world.radius_mm + 500.0;
      const double along = x.z() > world.height_mm - 1e-6 ? x.y() : x.z();
      return 150.0 + 90.0 * world.contrast * pattern(across / 1.6, along / 1.6, world.seed);
    }
  }
  const auto platter = meetHorizontalPlane(ray_in_table, 0.0);
  if (platter && platter->head<2>().norm() < world.platter_radius_mm) {
    return 110.0 + 70.0 * pattern(platter->x() / 4.0, platter->y() / 4.0, world.seed + 1);
  }
  // A wall 300 mm behind the axis, standing still.
  const double distance = (-300.0 - ray_in_base.origin.x()) / ray_in_base.direction.x();
  const Eigen::Vector3d wall = ray_in_base.origin + distance * ray_in_base.direction;
  return 100.0 + 80.0 * pattern(wall.y() / 4.0, wall.z() / 4.0, world.seed + 2);
}

Frame picture(const TurningCylinder& world, double table_angle_rad, Contents contents) {
  const Calibration calibration = world.calibration();
  const CameraModel& camera = calibration.camera;
  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  const Rigid3 table_from_base = baseFromTable(table_angle_rad).inverse();
  Frame frame;
  frame.table_angle_rad = table_angle_rad;
  frame.image_bgr.create(camera.height_px, camera.width_px, CV_8UC3);
  const auto turn = static_cast<std::uint64_t>(std::llround(table_angle_rad * 1e6));
  const auto rows = static_cast<std::size_t>(camera.height_px);
  parallelFor(rows, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      Random random(hashWords({world.seed, turn, contents == Contents::kCylinder ? 1U : 0U, row}));
      auto* line = frame.image_bgr.ptr<cv::Vec3b>(static_cast<int>(row));
      for (int column = 0; column < camera.width_px; ++column) {
        const Eigen::Vector2d pixel(column, static_cast<double>(row));
        const Ray in_base{base_from_cam.translation,
                          base_from_cam.rotation * camera.rayInCam(pixel)};
        const Ray in_table{table_from_base * in_base.origin,
                           table_from_base.rotation * in_base.direction};
        const double value =
            shade(world, in_table, in_base, contents) + world.noise_sigma * random.gaussian();
        const auto grey = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
        line[column] = {grey, grey, grey};
      }
    }
  });
  return frame;
}

}  // namespace

double pattern(double x, double y, std::uint64_t seed) {
  return 0.6 * smoothNoise(x, y, seed) + 0.4 * smoothNoise(x / 3.1, y / 3.1, seed + 77);
}

Calibration TurningCylinder::calibration() const {
  Calibration calibration;
  CameraModel& camera = calibration.camera;
  camera.width_px = 400;
  camera.height_px = 300;
  camera.fx = camera.fy = 1100.0;
  camera.cx = 204.0;
  camera.cy = 147.0;
  const double down_rad = radFromDeg(25.0);
  const Eigen::Vector3d target(0, 0, 20);
  const Eigen::Vector3d centre =
      target + 350.0 * Eigen::Vector3d(std::cos(down_rad), 0.0, std::sin(down_rad));
  const Eigen::Vector3d forward = (target - centre).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Rigid3 cam_from_table;
  cam_from_table.rotation.row(0) = right.transpose();
  cam_from_table.rotation.row(1) = forward.cross(right).transpose();
  cam_from_table.rotation.row(2) = forward.transpose();
  cam_from_table.translation = -(cam_from_table.rotation * centre);
  calibration.cam_from_table = cam_from_table;
  return calibration;
}

Frame TurningCylinder::render(double table_angle_rad) const {
  return picture(*this, table_angle_rad, Contents::kCylinder);
}

Frame TurningCylinder::renderEmpty(double table_angle_rad) const {
  return picture(*this, table_angle_rad, Contents::kNothing);
}

double TurningCylinder::distanceToSurface(const Eigen::Vector3d& point_in_table) const {
  const double side = std::abs(point_in_table.head<2>().norm() - radius_mm);
  const double lid = std::abs(point_in_table.z() - height_mm);
  return point_in_table.head<2>().norm() <= radius_mm ? std::min(side, lid) : side;
}

}  // namespace gyre::test
