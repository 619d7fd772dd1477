// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/rig.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/option_list.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/sim/object_models.h"

namespace gyre {
namespace {

// Words that keep the seed's uses apart.
enum SeedUse : std::uint64_t { kMotorWhite = 1, kMotorPhase = 2, kObjectPlace = 3, kTargetYaw = 4 };

Random randomFor(const RigSettings& rig, SeedUse use, std::int64_t index) {
  return Random(
      hashWords({static_cast<std::uint64_t>(rig.seed), use, static_cast<std::uint64_t>(index)}));
}

double motorErrorRad(const RigSettings& rig, std::int64_t steps, double nominal_rad) {
  const double phase_rad = randomFor(rig, kMotorPhase, 0).uniform(0.0, kTurn_rad);
  return radFromDeg(rig.once_per_turn_error_deg) * std::sin(nominal_rad + phase_rad) +
         radFromDeg(rig.white_error_deg) * randomFor(rig, kMotorWhite, steps).gaussian();
}

}  // namespace

Result<void> RigSettings::validate() const {
  if (auto ranges = validateRanges(*this); !ranges) return ranges;
  const auto& names = objectNames();
  if (object != "target" && std::find(names.begin(), names.end(), object) == names.end()) {
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    return Error{Error::Code::kInvalidInput, "The simulated rig has no object '" + object + "'.",
                 "Choose one of: " + known + ", target."};
  }
  if (motor_direction == 0) {
    return Error{Error::Code::kInvalidInput, "The simulated motor's direction is 0.",
                 "Use 1 or -1."};
  }
  if (material != "matte" && material != "glossy") {
    return Error{Error::Code::kInvalidInput,
                 "The simulated rig has no material '" + material + "'.",
                 "Choose matte or glossy."};
  }
  return {};
}

RigSettings atImageWidth(RigSettings rig, int width_px) {
  const double scale = static_cast<double>(width_px) / rig.image_width_px;
  rig.image_width_px = width_px;
  rig.image_height_px = static_cast<int>(std::lround(rig.image_height_px * scale));
  rig.focal_px *= scale;
  rig.principal_offset_x_px *= scale;
  rig.principal_offset_y_px *= scale;
  // Texture finer than the pixels can show would only be aliasing.
  rig.texture_finest_mm /= std::min(1.0, scale);
  return rig;
}

Calibration trueCalibration(const RigSettings& rig) {
  Calibration calibration;
  CameraModel& camera = calibration.camera;
  camera.width_px = rig.image_width_px;
  camera.height_px = rig.image_height_px;
  camera.fx = camera.fy = rig.focal_px;
  camera.cx = (rig.image_width_px - 1) / 2.0 + rig.principal_offset_x_px;
  camera.cy = (rig.image_height_px - 1) / 2.0 + rig.principal_offset_y_px;
  camera.k1 = rig.k1;

  const double elevation_rad = radFromDeg(rig.camera_elevation_deg);
  const double roll_rad = radFromDeg(rig.camera_roll_deg);
  const Eigen::Vector3d backward(std::cos(elevation_rad), 0.0, std::sin(elevation_rad));
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d down = right.cross(backward);
  Rigid3 cam_from_table;
  cam_from_table.rotation.row(0) = std::cos(roll_rad) * right + std::sin(roll_rad) * down;
  cam_from_table.rotation.row(1) = std::cos(roll_rad) * down - std::sin(roll_rad) * right;
  cam_from_table.rotation.row(2) = -backward;
  const Eigen::Vector3d camera_in_table =
      Eigen::Vector3d(0.0, 0.0, rig.aim_height_mm) + rig.camera_distance_mm * backward;
  cam_from_table.translation = -(cam_from_table.rotation * camera_in_table);
  calibration.cam_from_table = cam_from_table;
  return calibration;
}

CalibrationRecord trueRecord(const RigSettings& rig) {
  CalibrationRecord record(trueCalibration(rig));
  if (rig.object == "target" || rig.target.empty()) return record;
  record.target = rig.target;
  record.table_from_target = tableFromTarget(rig);
  return record;
}

Calibration bumpedCalibration(const RigSettings& rig) {
  Calibration calibration = trueCalibration(rig);
  // A camera that turns to its left by an angle sees everything f * angle further right.
  const double pan_rad = rig.bump_px / rig.focal_px;
  const Eigen::Matrix3d bumped_from_cam =
      Eigen::AngleAxisd(pan_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  calibration.cam_from_table->rotation = bumped_from_cam * calibration.cam_from_table->rotation;
  calibration.cam_from_table->translation =
      bumped_from_cam * calibration.cam_from_table->translation;
  return calibration;
}

bool isBumped(const RigSettings& rig, std::int64_t steps) {
  return (rig.bump_px != 0.0 || rig.push_mm != 0.0) &&
         360.0 * static_cast<double>(steps) >= rig.bump_at_deg * rig.steps_per_turn;
}

Eigen::Vector3d pushInBase(const RigSettings& rig) {
  // The camera looks along the base's x axis from its positive side.
  return {0.0, rig.push_mm, 0.0};
}

double trueAngleRad(const RigSettings& rig, std::int64_t steps) {
  const double nominal_rad = rig.motor_direction * kTurn_rad * static_cast<double>(steps) /
                             static_cast<double>(rig.steps_per_turn);
  return nominal_rad * (1.0 + rig.step_scale_error) + motorErrorRad(rig, steps, nominal_rad) -
         motorErrorRad(rig, 0, 0.0);
}

Eigen::Vector3d keyLightInBase(const RigSettings& rig) {
  const Eigen::Matrix3d cam_from_base = trueCalibration(rig).cam_from_table->rotation;
  const double angle_rad = radFromDeg(rig.key_light_deg);
  const double aside = -std::sin(angle_rad) / std::sqrt(2.0);  // left and up in the picture
  return cam_from_base.transpose() * Eigen::Vector3d(aside, aside, -std::cos(angle_rad));
}

Eigen::Vector2d objectOffsetInTable(const RigSettings& rig) {
  const double direction_rad = randomFor(rig, kObjectPlace, 0).uniform(0.0, kTurn_rad);
  return rig.object_offset_mm * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
}

Rigid3 tableFromTarget(const RigSettings& rig) {
  Rigid3 table_from_target;
  table_from_target.rotation =
      Eigen::AngleAxisd(randomFor(rig, kTargetYaw, 0).uniform(0.0, kTurn_rad),
                        Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  if (rig.object == "target") table_from_target.translation.head<2>() = objectOffsetInTable(rig);
  return table_from_target;
}

}  // namespace gyre
