// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/background.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr std::uint64_t kBackgroundUse = 21;
constexpr double kDeskHeight_mm = -25.0;
constexpr double kPlatterThickness_mm = 6.0;
constexpr int kClutter = 16;

}  // namespace

Background::Background(const RigSettings& rig, const Eigen::Vector3d& push)
    : texture_(hashWords({static_cast<std::uint64_t>(rig.seed), kBackgroundUse}),
               1.6 * rig.texture_finest_mm, std::max(30.0, 4.0 * rig.texture_finest_mm)),
      light_(keyLightInBase(rig)),
      ambient_(rig.ambient_light),
      key_(rig.key_light),
      platter_radius_mm_(rig.platter_radius_mm),
      platter_in_base_(push) {
  Random random(hashWords({static_cast<std::uint64_t>(rig.seed), kBackgroundUse, 1}));
  for (int i = 0; i < kClutter; ++i) {
    Box box;
    // Behind and beside the platter, out of the way of its turning; the camera is at +x.
    const double direction_rad = random.uniform(0.55 * kPi, 1.45 * kPi);
    box.half = {random.uniform(6.0, 22.0), random.uniform(6.0, 28.0), random.uniform(5.0, 26.0)};
    const double reach = platter_radius_mm_ + box.half.head<2>().norm() + 6.0;
    const double distance = reach + random.uniform(0.0, 130.0);
    box.centre = {distance * std::cos(direction_rad), distance * std::sin(direction_rad),
                  kDeskHeight_mm + box.half.z()};
    box.box_from_base =
        Eigen::AngleAxisd(-random.uniform(0.0, kPi), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (int channel = 0; channel < 3; ++channel) {
      box.paint[channel] = static_cast<float>(random.uniform(0.25, 0.95));
    }
    boxes_.push_back(box);
  }
}

void Background::meetBox(const Box& box, const Ray& ray, Hit& nearest) {
  // Most rays pass most boxes by: the distance of the box's middle from the ray says so at once.
  const Eigen::Vector3d to_box = box.centre - ray.origin;
  const double along = to_box.dot(ray.direction);
  if (to_box.squaredNorm() - along * along > box.half.squaredNorm()) return;
  // In the box's own frame it is the product of three slabs.
  const Eigen::Vector3d origin = box.box_from_base * (ray.origin - box.centre);
  const Eigen::Vector3d direction = box.box_from_base * ray.direction;
  double from = 0.0;
  double to = nearest.distance;
  int entered = -1;
  for (int axis = 0; axis < 3; ++axis) {
    double near = (-box.half[axis] - origin[axis]) / direction[axis];
    double far = (box.half[axis] - origin[axis]) / direction[axis];
    if (near > far) std::swap(near, far);
    if (near > from) {
      from = near;
      entered = axis;
    }
    to = std::min(to, far);
  }
  if (entered < 0 || from >= to) return;
  const Eigen::Vector3d normal =
      -std::copysign(1.0, direction[entered]) * Eigen::Vector3d::Unit(entered);
  nearest = {from, box.box_from_base.transpose() * normal, box.paint};
}

void Background::meetDesk(const Ray& ray, Hit& nearest) const {
  const double distance = (kDeskHeight_mm - ray.origin.z()) / ray.direction.z();
  if (!(distance > 0.0) || distance >= nearest.distance) return;
  nearest = {distance, Eigen::Vector3d::UnitZ(), {0.62F, 0.5F, 0.38F}};
}

void Background::meetPlatterSide(const Ray& ray, Hit& nearest) const {
  const Eigen::Vector3d origin = ray.origin - platter_in_base_;
  const auto span =
      crossCylinder({origin, ray.direction}, platter_radius_mm_, -kPlatterThickness_mm, 0.0);
  if (!span || span->from <= 0.0 || span->from >= nearest.distance) return;
  const Eigen::Vector3d at = origin + span->from * ray.direction;
  nearest = {span->from, Eigen::Vector3d(at.x(), at.y(), 0.0).normalized(), {0.12F, 0.12F, 0.13F}};
}

Eigen::Vector3f Background::radiance(const Ray& ray_in_base) const {
  constexpr double kWall_mm = 5000.0;  // what is beyond the desk is a far, dim wall
  Hit nearest{kWall_mm, Eigen::Vector3d::UnitX(), {0.35F, 0.36F, 0.38F}};
  meetDesk(ray_in_base, nearest);
  for (const Box& box : boxes_) meetBox(box, ray_in_base, nearest);
  meetPlatterSide(ray_in_base, nearest);
  const Eigen::Vector3d at = ray_in_base.origin + nearest.distance * ray_in_base.direction;
  const Eigen::Array4f noise = texture_.at(at.cast<float>());
  const Eigen::Array3f tint =
      1.0F + 0.15F * (noise.tail<3>() / (1.0F + noise.tail<3>().square()).sqrt());
  const float bright = 0.68F + 0.3F * noise[0] / std::sqrt(1.0F + noise[0] * noise[0]);
  const auto light =
      static_cast<float>(ambient_ + key_ * std::max(0.0, nearest.normal.dot(light_)));
  return (light * bright * nearest.paint.array() * tint).min(1.0F).matrix();
}

}  // namespace gyre
