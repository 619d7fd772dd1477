// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/synthetic_turn.h"

#include <cmath>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/rig.h"

namespace gyre {
namespace {

constexpr double kRoundingVariance_px2 = 1.0 / 12.0;

// A camera without distortion that looks at the middle of the sphere, the table's origin.
Calibration calibrationOf(const SyntheticTurnOptions& options) {
  RigSettings rig;
  rig.image_width_px = 1600;
  rig.image_height_px = 1200;
  rig.focal_px = options.focal_px;
  rig.principal_offset_x_px = 0.0;
  rig.principal_offset_y_px = 0.0;
  rig.k1 = 0.0;
  rig.camera_distance_mm = options.distance_mm;
  rig.camera_elevation_deg = options.elevation_deg;
  rig.camera_roll_deg = 0.0;
  rig.aim_height_mm = 0.0;
  return trueCalibration(rig);
}

Eigen::Vector3d pointInSphere(double radius_mm, Random& random) {
  Eigen::Vector3d point;
  do {
    for (double& coordinate : point) coordinate = random.uniform(-1.0, 1.0);
  } while (point.squaredNorm() > 1.0);
  return radius_mm * point;
}

}  // namespace

SyntheticTurn syntheticTurn(const SyntheticTurnOptions& options, std::uint64_t seed) {
  GYRE_CHECK(options.views > 0 && options.points > 0);
  GYRE_CHECK(options.distance_mm > options.sphere_radius_mm);
  Random random(hashWords({seed, 0x7075'726e}));
  SyntheticTurn turn;
  const Calibration calibration = calibrationOf(options);
  turn.camera = calibration.camera;
  turn.sigma_px = std::sqrt(options.noise_px * options.noise_px +
                            (options.whole_pixels ? kRoundingVariance_px2 : 0.0));
  const Rigid3& at_zero = *calibration.cam_from_table;
  for (int view = 0; view < options.views; ++view) {
    const double told_rad = radFromDeg(view * options.step_deg);
    const double noise_rad =
        view == 0 ? 0.0 : radFromDeg(options.angle_noise_deg) * random.gaussian();
    turn.told_angles_rad.push_back(told_rad);
    turn.true_angles_rad.push_back(told_rad * (1.0 + options.angle_scale_error) + noise_rad);
    turn.cam_from_table.push_back(camFromTable(at_zero, told_rad));
  }
  for (int point = 0; point < options.points; ++point) {
    turn.points_in_table.push_back(pointInSphere(options.sphere_radius_mm, random));
    Track track;
    track.id = static_cast<std::uint32_t>(point);
    for (int view = 0; view < options.views; ++view) {
      const double angle_rad = turn.true_angles_rad[static_cast<std::size_t>(view)];
      Eigen::Vector2d pixel =
          *turn.camera.project(camFromTable(at_zero, angle_rad) * turn.points_in_table.back());
      for (double& coordinate : pixel) coordinate += options.noise_px * random.gaussian();
      if (options.whole_pixels) pixel = pixel.array().round();
      track.observations.push_back({view, pixel, turn.sigma_px});
    }
    turn.tracks.push_back(std::move(track));
  }
  return turn;
}

}  // namespace gyre
