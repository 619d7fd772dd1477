// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/turned_target.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/rig.h"

namespace gyre::test {
namespace {

constexpr double kSteepest = 0.26;  // cosine of 75 deg

struct Sheet {
  Eigen::Vector3d middle;
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  int columns;
  int rows;
  double spacing_mm;
};

// Appends a lattice and its face; right x down points into the target, as printed sheets have it.
void addSheet(const Sheet& sheet, Target& target) {
  std::vector<int> ids;
  for (int row = 0; row < sheet.rows; ++row) {
    for (int column = 0; column < sheet.columns; ++column) {
      const int id = static_cast<int>(target.corners.size());
      target.corners.push_back(
          {id,
           sheet.middle + sheet.spacing_mm * ((column - 0.5 * (sheet.columns - 1)) * sheet.right +
                                              (row - 0.5 * (sheet.rows - 1)) * sheet.down)});
      ids.push_back(id);
    }
  }
  target.faces.push_back(ids);
  target.page_axes.push_back({sheet.right, sheet.down});
}

}  // namespace

Target wedgeTarget() {
  Target target;
  target.name = "wedge";
  const double slope_rad = radFromDeg(40.0);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d down(std::cos(slope_rad), 0.0, -std::sin(slope_rad));
  addSheet({{0.0, 0.0, 25.0}, right, down, 9, 7, 9.0}, target);
  addSheet({{-30.0, 0.0, 24.0}, -right, -Eigen::Vector3d::UnitZ(), 9, 4, 9.0}, target);
  for (const double side : {-1.0, 1.0}) {
    addSheet({{-18.0, 42.0 * side, 15.0},
              -side * Eigen::Vector3d::UnitX(),
              -Eigen::Vector3d::UnitZ(),
              4,
              3,
              7.0},
             target);
  }
  return target;
}

Target cubeTarget() {
  Target target;
  target.name = "cube";
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  addSheet({60.0 * up, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), 6, 6, 8.0}, target);
  for (int side = 0; side < 4; ++side) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * kPi * side, up).toRotationMatrix();
    addSheet(
        {turn * Eigen::Vector3d(30.0, 0.0, 30.0), turn * Eigen::Vector3d::UnitY(), -up, 6, 6, 8.0},
        target);
  }
  return target;
}

Target flatTarget() {
  Target target;
  target.name = "board";
  addSheet({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), 9, 7, 9.0},
           target);
  return target;
}

Target ringTarget(int markers, double radius_mm, double side_mm) {
  Target target;
  target.name = "ring";
  for (int i = 0; i < markers; ++i) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(kTurn_rad * i / markers, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    TargetMarker marker;
    marker.id = i;
    const Eigen::Vector3d middle(radius_mm, 0.0, 0.0);
    const double h = 0.5 * side_mm;
    // Clockwise from above.
    marker.corners_in_target = {turn * (middle + Eigen::Vector3d(-h, -h, 0.0)),
                                turn * (middle + Eigen::Vector3d(-h, h, 0.0)),
                                turn * (middle + Eigen::Vector3d(h, h, 0.0)),
                                turn * (middle + Eigen::Vector3d(h, -h, 0.0))};
    target.markers.push_back(marker);
  }
  return target;
}

TurnedTarget::TurnedTarget(Target seen) : target(std::move(seen)) {
  for (const TargetPoint& point : pointsOf(target)) true_points.push_back(point.position_in_target);
  table_from_target.rotation = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  table_from_target.translation = {3.0, -2.0, 0.0};
  truth = trueCalibration(RigSettings{});
  setSteps(24, radFromDeg(15.0));
}

void TurnedTarget::setSteps(int views, double step_rad) {
  commanded_rad.clear();
  for (int k = 0; k < views; ++k) commanded_rad.push_back(step_rad * k);
  true_rad = commanded_rad;
}

std::vector<TargetView> TurnedTarget::views(std::uint64_t seed) const {
  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<TargetView> views;
  for (std::size_t k = 0; k < true_rad.size(); ++k) {
    TargetView view;
    view.name = "view" + std::to_string(k + 1);
    view.table_angle_rad = commanded_rad[k];
    const Rigid3 cam_from_target =
        camFromTable(*truth.cam_from_table, true_rad[k]) * table_from_target;
    Random random(hashWords({seed, k}));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d in_cam = cam_from_target * true_points[i];
      Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();
      if (points[i].face >= 0) {
        const PageAxes& page = target.page_axes[static_cast<std::size_t>(points[i].face)];
        outward = page.down_in_target.cross(page.right_in_target);
      }
      if ((cam_from_target.rotation * outward).dot(-in_cam.normalized()) < kSteepest) continue;
      const auto pixel = truth.camera.project(in_cam);
      if (!pixel || !truth.camera.contains(*pixel, 5.0)) continue;
      const double dx = noise_px * random.gaussian();
      const double dy = noise_px * random.gaussian();
      view.sightings.push_back({static_cast<int>(i), *pixel + Eigen::Vector2d(dx, dy), 0.05});
    }
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace gyre::test
