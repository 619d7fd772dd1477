// A target on an odd turntable, seen by a finder that knows the truth: nothing is rendered.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/base/random.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/geometry/turntable_pose.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"
#include "core/sim/rig.h"

namespace gyre::test {

// Two faces of lattice points, at right angles, standing on the table.
inline constexpr double kSighting_sigma_px = 0.05;

inline Target wedge() {
  Target target;
  target.name = "wedge";
  for (int face = 0; face < 2; ++face) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double along = 10.0 * (column - 1.5);
        const double up = 8.0 + 10.0 * row;
        target.corners.push_back(
            {static_cast<int>(target.corners.size()),
             face == 0 ? Eigen::Vector3d(20.0, along, up) : Eigen::Vector3d(along, 20.0, up)});
      }
    }
  }
  return target;
}

// What stands on the platter, seen exactly but for noise; nothing is rendered.
class World {
 public:
  // The truth of the table's angle, wherever it comes from. [rad]
  std::function<double()> angle_rad;
  bool visible = true;
  int pictures = 0;
  double largest_move_rad = 0.0;

  Result<TargetView> look() {
    const double now_rad = angle_rad();
    if (pictures++ > 0) {
      largest_move_rad = std::max(largest_move_rad, std::abs(now_rad - last_rad_));
    }
    last_rad_ = now_rad;
    if (!visible)
      return Error{Error::Code::kNotFound, "The target is not in the picture.", "Look."};
    const Calibration truth = trueCalibration({});
    Rigid3 table_from_target;
    table_from_target.translation = {6.0, -9.0, 0.0};
    TargetView view;
    Random random(static_cast<std::uint64_t>(pictures));
    const Target target = wedge();
    for (std::size_t i = 0; i < target.corners.size(); ++i) {
      const Eigen::Vector3d x = table_from_target * target.corners[i].position_in_target;
      const auto pixel = truth.camera.project(camFromTable(*truth.cam_from_table, now_rad) * x);
      const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
      view.sightings.push_back(
          {static_cast<int>(i), *pixel + kSighting_sigma_px * noise, kSighting_sigma_px});
    }
    return view;
  }

 private:
  double last_rad_ = 0.0;
};

// Pictures of the right size in which the finder does not look.
class BlankCamera final : public Camera {
 public:
  Result<FramePtr> grabAfter(double, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    Frame frame;
    frame.image_bgr = cv::Mat::zeros(960, 1280, CV_8UC3);
    return std::make_shared<const Frame>(frame);
  }
  Result<CameraInfo> lockControls() override { return CameraInfo{}; }
  CameraInfo info() const override { return {}; }
};

// A table that obeys at once, in its own way.
class OddTable final : public Turntable {
 public:
  explicit OddTable(std::function<double(double told_rad)> turned_rad)
      : turned_rad_(std::move(turned_rad)) {}

  Result<void> moveTo(double angle_rad, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    const double to_rad = zero_rad_ + angle_rad / turned_over_told_;
    if (angle_rad < angleRad() && approach_rad_ > 0.0) {
      told_rad_ = to_rad - approach_rad_ / turned_over_told_;
      (void)trueAngleRad();  // what has play follows on the way
    }
    told_rad_ = to_rad;
    (void)trueAngleRad();
    return {};
  }
  void setApproach(double approach_rad) override { approach_rad_ = approach_rad; }
  double approachRad() const override { return approach_rad_; }
  double angleRad() const override { return (told_rad_ - zero_rad_) * turned_over_told_; }
  double trueAngleRad() const { return turned_rad_(told_rad_); }
  std::int64_t steps() const override { return 0; }
  TablePlace place() const override { return {}; }
  std::optional<double> angleAt(const TablePlace&) const override { return std::nullopt; }
  Result<void> setAngle(double) override { return {}; }
  void stop() noexcept override { stopped = true; }
  Result<void> release() override { return {}; }
  Result<void> correct(double turned_over_told) override {
    zero_rad_ = told_rad_;
    turned_over_told_ *= turned_over_told;
    return {};
  }
  TurntableInfo info() const override {
    TurntableInfo info;
    info.device_id = "an odd table";
    info.axis = "X";
    info.units_per_turn = 360.0 / std::abs(turned_over_told_);
    info.direction = turned_over_told_ < 0.0 ? -1 : 1;
    if (!may_unlock) info.lock = lock;
    return info;
  }
  void allowUnlock() override { may_unlock = true; }

  bool stopped = false;
  std::string lock;
  bool may_unlock = false;

 private:
  std::function<double(double)> turned_rad_;
  double told_rad_ = 0.0;
  double zero_rad_ = 0.0;
  double turned_over_told_ = 1.0;
  double approach_rad_ = 0.0;
};

}  // namespace gyre::test
