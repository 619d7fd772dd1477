// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/stage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sim/background.h"

namespace gyre {
namespace {

constexpr std::uint64_t kPlatterUse = 31;

// Where within a pixel the world that stands still is sampled: a turned square, in pixels.
const std::array<Eigen::Vector2d, 4> kSubPixels = {
    Eigen::Vector2d(-0.125, -0.375), Eigen::Vector2d(0.375, -0.125), Eigen::Vector2d(0.125, 0.375),
    Eigen::Vector2d(-0.375, 0.125)};

}  // namespace

Stage::Stage(const RigSettings& rig, const Calibration& calibration,
             const Eigen::Vector3d& push_in_base)
    : width_px_(rig.image_width_px),
      platter_texture_(hashWords({static_cast<std::uint64_t>(rig.seed), kPlatterUse}),
                       2.2 * rig.texture_finest_mm, std::max(16.0, 5.0 * rig.texture_finest_mm)),
      platter_light_(static_cast<float>(rig.ambient_light +
                                        rig.key_light * std::max(0.0, keyLightInBase(rig).z()))) {
  const Rigid3 base_from_cam = calibration.cam_from_table->inverse();
  camera_in_base_ = base_from_cam.translation - push_in_base;
  const auto pixels =
      static_cast<std::size_t>(rig.image_width_px) * static_cast<std::size_t>(rig.image_height_px);
  direction_.resize(pixels);
  coverage_.resize(pixels);
  platter_point_in_base_.resize(pixels);
  background_.resize(pixels);
  const Background background(rig, push_in_base);
  const auto cast_pixel = [&](int x, int y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
                              static_cast<std::size_t>(x);
    const Eigen::Vector2d normalized = calibration.camera.normalizedFromPixel({x, y});
    const Eigen::Vector3d centre = base_from_cam.rotation * normalized.homogeneous();
    direction_[pixel] = centre.cast<float>();
    if (const auto at = meetHorizontalPlane({camera_in_base_, centre}, 0.0)) {
      platter_point_in_base_[pixel] = at->head<2>().cast<float>();
    }
    const Eigen::Matrix<double, 3, 2> direction_per_px =
        base_from_cam.rotation.leftCols<2>() *
        calibration.camera.pixelJacobian(normalized).inverse();
    int on_platter = 0;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const Eigen::Vector2d& offset_px : kSubPixels) {
      const Eigen::Vector3d direction = (centre + direction_per_px * offset_px).normalized();
      const auto at = meetHorizontalPlane({camera_in_base_, direction}, 0.0);
      if (camera_in_base_.z() > 0.0 && at && at->head<2>().norm() <= rig.platter_radius_mm) {
        ++on_platter;
      } else {
        sum += background.radiance({base_from_cam.translation, direction});
      }
    }
    const int beside = static_cast<int>(kSubPixels.size()) - on_platter;
    coverage_[pixel] = static_cast<float>(on_platter) / static_cast<float>(kSubPixels.size());
    background_[pixel] = sum / static_cast<float>(std::max(beside, 1));
  };
  parallelFor(static_cast<std::size_t>(rig.image_height_px), 4,
              [&](std::size_t begin, std::size_t end) {
                for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                  for (int x = 0; x < width_px_; ++x) cast_pixel(x, y);
              });
}

Eigen::Vector3f Stage::platterLight(const Eigen::Vector2f& point_in_table) const {
  const Eigen::Array4f noise = platter_texture_.at({point_in_table.x(), point_in_table.y(), 0.0F});
  const float bright = 0.5F + 0.3F * noise[0] / std::sqrt(1.0F + noise[0] * noise[0]);
  const Eigen::Array3f tint = noise.tail<3>() / (1.0F + noise.tail<3>().square()).sqrt();
  const Eigen::Array3f ground(0.62F, 0.72F, 0.8F);
  return (platter_light_ * (ground * bright + 0.06F * tint)).max(0.0F).min(1.0F).matrix();
}

void Stage::paintRow(int y, double table_angle_rad, float background_brightness,
                     LightImage& light) const {
  const Eigen::Matrix2f table_from_base =
      Eigen::Rotation2Dd(-table_angle_rad).toRotationMatrix().cast<float>();
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_);
  float* out = light.row(y);
  for (std::size_t x = 0; x < static_cast<std::size_t>(width_px_); ++x) {
    const std::size_t pixel = first + x;
    const float coverage = coverage_[pixel];
    Eigen::Vector3f rgb = (1.0F - coverage) * background_brightness * background_[pixel];
    if (coverage > 0.0F) {
      rgb += coverage * platterLight(table_from_base * platter_point_in_base_[pixel]);
    }
    out[3 * x] = rgb.z();
    out[3 * x + 1] = rgb.y();
    out[3 * x + 2] = rgb.x();
  }
}

}  // namespace gyre
