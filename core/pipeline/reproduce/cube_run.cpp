// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/cube_run.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/calib/lens/calibrate_points.h"
#include "core/calib/targets/standard_targets.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/pipeline/solve_and_check.h"
#include "core/pipeline/target_finder.h"
#include "core/recover/turn_estimator.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

constexpr int kTurnPictures = 24;
constexpr int kViewsInTurn = 200;  // the paper's step of 1.8 deg
constexpr double kByHand_rad = radFromDeg(0.2);
constexpr double kByHand_mm = 0.5;
constexpr double kCube_mm = 100.0;

// So many pictures, of which a whole turn would have in_turn.
struct Series {
  int pictures = 0;
  int in_turn = 0;
};

Result<std::vector<TargetView>> viewsOf(const Renderer& renderer, const Target& target,
                                        const Series& series, const Task& task) {
  const SoughtTarget sought = soughtTarget(target);
  std::vector<TargetView> views;
  views.reserve(static_cast<std::size_t>(series.pictures));
  for (int k = 0; k < series.pictures; ++k) {
    task.report(static_cast<double>(k) / series.pictures, "Finding the cube's corners");
    if (task.stopRequested()) return cancelled();
    const std::int64_t steps = renderer.rig().steps_per_turn * k / series.in_turn;
    auto view = sought.find(renderer.render(steps, TableLoad::kObject).image_bgr);
    if (!view) return view.error();
    view->table_angle_rad = kTurn_rad * k / series.in_turn;
    views.push_back(std::move(*view));
  }
  return views;
}

// Turned and shifted by guess, by one standard deviation about and along each axis.
Rigid3 placedByHand(const Rigid3& table_from_target, int seed) {
  Random random(hashWords({static_cast<std::uint64_t>(seed), 0x6861'6e64}));
  const auto gaussian = [&random] {
    const double x = random.gaussian();
    const double y = random.gaussian();
    return Eigen::Vector3d(x, y, random.gaussian());
  };
  const Eigen::Vector3d turn_rad = kByHand_rad * gaussian();
  Rigid3 off;
  off.rotation = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  off.translation = kByHand_mm * gaussian();
  return off * table_from_target;
}

// The sightings of each corner by its index among the target's points.
using CornerSightings = std::map<int, std::vector<Sighting>>;

CornerSightings sightingsOf(std::span<const TargetView> views, const CameraModel& camera,
                            std::size_t corners) {
  CornerSightings all;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (const PointSighting& seen : views[view].sightings) {
      if (static_cast<std::size_t>(seen.point) >= corners) continue;  // a marker's corner
      all[seen.point].push_back({static_cast<std::int32_t>(view),
                                 camera.normalizedFromPixel(seen.pixel),
                                 seen.sigma_px / camera.fx});
    }
  }
  return all;
}

RecoverOptions recoverOf(CubeWay way) {
  RecoverOptions options;
  options.solver = way == CubeWay::kWholeTurn ? "robust" : "squared";
  if (way != CubeWay::kWholeTurn) options.angle_freedom_deg = 0.0;
  return options;
}

}  // namespace

Result<CubeRun> CubeRun::make(const RigSettings& rig, int views, const Task& task) {
  CubeRun run;
  run.rig_ = rig;
  run.target_ = standardTarget("cube").value().target;
  const auto printed = PrintedTarget::make(run.target_, rig);
  if (!printed) return printed.error();
  const Rigid3 table_from_target = tableFromTarget(rig);
  for (const TargetCorner& corner : (*printed)->truth().corners) {
    run.corners_in_table_.push_back(table_from_target * corner.position_in_target);
  }
  const Renderer renderer(rig, *printed);
  const double share = static_cast<double>(views) / (views + kTurnPictures);
  auto row = viewsOf(renderer, run.target_, {views, kViewsInTurn}, task.part(0.0, share));
  if (!row) return row.error();
  run.row_ = std::move(*row);
  auto turn = viewsOf(renderer, run.target_, {kTurnPictures, kTurnPictures}, task.part(share, 1.0));
  if (!turn) return turn.error();
  run.turn_ = std::move(*turn);
  return run;
}

Result<Calibration> CubeRun::calibrate(CubeWay way, const Task& task) const {
  if (way == CubeWay::kWholeTurn) {
    RigBundleOptions options;
    options.image_width_px = rig_.image_width_px;
    options.image_height_px = rig_.image_height_px;
    options.object_size_mm = kCube_mm;
    auto solved = solveAndCheck(turn_, target_, options, task);
    if (!solved) return solved.error();
    return solved->rig.calibration;
  }
  const Rigid3 placed = way == CubeWay::kPlacedExactly
                            ? tableFromTarget(rig_)
                            : placedByHand(tableFromTarget(rig_), rig_.seed);
  const auto points = pointsOf(target_);
  std::vector<KnownPoint> known;
  known.reserve(row_.front().sightings.size());
  for (const PointSighting& seen : row_.front().sightings) {
    const auto& point = points[static_cast<std::size_t>(seen.point)];
    known.push_back({placed * point.position_in_target, seen.pixel});
  }
  PointsOptions options;
  options.mode = PointsMode::kPaper;
  options.image_size_px = {rig_.image_width_px, rig_.image_height_px};
  auto solved = calibratePoints(known, options, task);
  if (!solved) return solved.error();
  return solved->calibration;
}

CubeError CubeRun::measure(const Calibration& calibration, CubeWay way, int views) const {
  const std::span<const TargetView> used = std::span(row_).first(static_cast<std::size_t>(views));
  std::vector<Rigid3> poses;
  poses.reserve(used.size());
  for (const TargetView& view : used) {
    poses.push_back(camFromTable(*calibration.cam_from_table, *view.table_angle_rad));
  }
  const CornerSightings sightings = sightingsOf(used, calibration.camera, corners_in_table_.size());
  std::vector<TrackSightings> tracks;
  std::vector<int> corner_of_track;
  for (const auto& [corner, seen] : sightings) {
    tracks.push_back({seen, static_cast<std::uint64_t>(corner)});
    corner_of_track.push_back(corner);
  }
  const RecoverOptions options = recoverOf(way);
  std::vector<double> expected_rad(used.size(), radFromDeg(options.angle_sigma_deg));
  std::vector<double> freedom_rad(used.size(), radFromDeg(options.angle_freedom_deg));
  expected_rad.front() = freedom_rad.front() = 0.0;
  const auto solved = estimateTurn(tracks, poses, {expected_rad, freedom_rad}, options, Task());
  CubeError error;
  if (!solved) return error;
  double rays = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!solved->points[i]) continue;
    const Eigen::Vector3d& found = solved->points[i]->position_in_table;
    const auto corner = static_cast<std::size_t>(corner_of_track[i]);
    error.reconstruction_mm += (found - corners_in_table_[corner]).norm();
    ++error.corners;
    for (const Sighting& seen : tracks[i].sightings) {
      const auto view = static_cast<std::size_t>(seen.view);
      const Rigid3 pose = camFromTable(poses[view], solved->corrections_rad[view]);
      error.calibration_mm += distanceToLine(rayThrough(pose, seen.normalized), found);
      rays += 1.0;
    }
  }
  if (error.corners > 0) {
    error.reconstruction_mm /= error.corners;
    error.calibration_mm /= rays;
  }
  return error;
}

}  // namespace gyre
