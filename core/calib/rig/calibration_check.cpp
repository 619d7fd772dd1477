// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/calibration_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/base/formatted.h"
#include "core/calib/rig/rig_problem.h"
#include "core/calib/rig/rig_refusals.h"
#include "core/calib/rig/rig_start.h"

namespace gyre {
namespace {

constexpr double kLoss_sigma = 3.0;
constexpr double kOutlier_sigma = 6.0;
constexpr std::size_t kLeastLooks = 3;
constexpr std::size_t kLeastPoints = 6;
constexpr double kLeastArc_rad = radFromDeg(20.0);
constexpr double kOtherTarget = 0.02;  // share of the picture's width by which others are off
constexpr int kNewtonSteps = 10;
constexpr int kAnglesTried = 360;

// The second target's place and the angles, camera and axis held.
Result<RigState> placeTarget(const Calibration& calibration, std::span<const TargetView> views,
                             const Target& target, RigScene& scene, const Task& task) {
  RigBundleOptions options;
  options.image_width_px = calibration.camera.width_px;
  options.image_height_px = calibration.camera.height_px;
  options.fixed_camera = calibration.camera;
  options.shape = TargetShape::kExact;
  // A target of the wrong size, or a calibration that is off, is what shall be measured.
  options.max_median_px = kOtherTarget * calibration.camera.width_px;
  if (auto valid = checkViews(views, target, options); !valid) return valid.error();
  scene = sceneOf(views, target, TargetShape::kExact);
  auto start = startOf(views, target, scene, options, task);
  if (!start) return start.error();
  RigFrames& frames = start->frames;
  const Rigid3 cam_from_target = frames.cam_from_base * frames.table_from_target;
  frames.cam_from_base = *calibration.cam_from_table;
  frames.table_from_target = frames.cam_from_base.inverse() * cam_from_target;
  RigFreedom freedom;
  freedom.axis = false;
  for (const double loss : {10.0 * kLoss_sigma, kLoss_sigma}) {
    auto solved = solveRig(scene, {freedom, {}, loss}, *start, task);
    if (!solved) return solved.error();
  }
  if (auto fits = checkFits(scene, *start, options, target.name); !fits) return fits.error();
  return start;
}

// The point as its sightings alone have it, in the target frame; nothing when they are too few.
std::optional<Eigen::Vector3d> measuredPoint(const RigScene& scene, const RigState& state,
                                             std::size_t index) {
  std::vector<const RigSighting*> looks;
  std::vector<double> angles;
  for (const RigSighting& seen : scene.sightings) {
    if (seen.point != index || !seen.used) continue;
    looks.push_back(&seen);
    angles.push_back(state.angles_rad[seen.view]);
  }
  if (looks.size() < kLeastLooks || coveredArc(angles) < kLeastArc_rad) return std::nullopt;
  FacePoint point = scene.points[index];
  point.from_middle.setZero();
  for (int step = 0; step < kNewtonSteps; ++step) {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const RigSighting* seen : looks) {
      Eigen::Vector2d pixel;
      RigJacobian by;
      if (!projectRig(state.frames, state.at(seen->view, scene.face_of[index]), point, &pixel,
                      &by)) {
        return std::nullopt;
      }
      const double weight = 1.0 / (seen->sigma_px * seen->sigma_px);
      hessian += weight * by.point_in_target.transpose() * by.point_in_target;
      gradient += weight * by.point_in_target.transpose() * (seen->pixel - pixel);
    }
    const Eigen::Vector3d move = hessian.ldlt().solve(gradient);
    point.position_in_target += move;
    if (move.norm() < 1e-9) break;
  }
  return point.position_in_target;
}

double rmsOf(const Eigen::Matrix3Xd& off) {
  return std::sqrt(off.squaredNorm() / static_cast<double>(off.cols()));
}

double leaveOutliers(RigScene& scene, const RigState& state) {
  const std::vector<Eigen::Vector2d> residuals = residualsOf(scene, state);
  std::vector<double> off;
  off.reserve(residuals.size());
  for (const Eigen::Vector2d& residual : residuals) off.push_back(residual.norm());
  std::vector<double> sorted = off;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  double squares = 0.0;
  double used = 0.0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    scene.sightings[i].used = off[i] <= kOutlier_sigma * *middle;
    if (!scene.sightings[i].used) continue;
    squares += off[i] * off[i];
    used += 1.0;
  }
  return std::sqrt(squares / std::max(used, 1.0));
}

// Squared misfit of a picture with the table at an angle.
double misfit(const RigScene& scene, RigState& state, double angle_rad) {
  state.angles_rad[0] = angle_rad;
  double sum = 0.0;
  for (const Eigen::Vector2d& residual : residualsOf(scene, state)) sum += residual.squaredNorm();
  return sum;
}

double bestAngle(const RigScene& scene, RigState& state) {
  const double step_rad = kTurn_rad / kAnglesTried;
  double best_rad = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kAnglesTried; ++i) {
    const double sum = misfit(scene, state, step_rad * i);
    if (sum >= least) continue;
    least = sum;
    best_rad = step_rad * i;
  }
  // Golden section: the misfit has one valley within a step of the best.
  constexpr double kGolden = 0.6180339887498949;
  double low = best_rad - step_rad;
  double high = best_rad + step_rad;
  for (int i = 0; i < 60; ++i) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    if (misfit(scene, state, a) < misfit(scene, state, b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

Result<CalibrationCheck> checkCalibration(const Calibration& calibration,
                                          std::span<const TargetView> views, const Target& target,
                                          const Task& task) {
  if (!calibration.cam_from_table) {
    return Error{Error::Code::kInvalidInput, "This calibration knows no turntable.",
                 "Calibrate with the target on the table."};
  }
  RigScene scene;
  const auto state = placeTarget(calibration, views, target, scene, task);
  if (!state) return state.error();
  CalibrationCheck check;
  check.rms_px = leaveOutliers(scene, *state);
  std::vector<Eigen::Vector3d> measured;
  std::vector<Eigen::Vector3d> known;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    const auto point = measuredPoint(scene, *state, i);
    if (!point) continue;
    measured.push_back(*point);
    known.push_back(scene.points[i].position_in_target);
  }
  check.points = measured.size();
  if (check.points < kLeastPoints) {
    return Error{Error::Code::kTooFew,
                 formatted("Only %zu points of the check target could be measured.", check.points),
                 "Take pictures of it all around a turn, about every 15 deg."};
  }
  const auto count = static_cast<Eigen::Index>(check.points);
  const Eigen::Map<const Eigen::Matrix3Xd> from(known.front().data(), 3, count);
  const Eigen::Map<const Eigen::Matrix3Xd> to(measured.front().data(), 3, count);
  const Eigen::Matrix4d rigid = Eigen::umeyama(from, to, false);
  const Eigen::Matrix4d similar = Eigen::umeyama(from, to, true);
  check.error_mm = rmsOf(to - (rigid * from.colwise().homogeneous()).topRows<3>());
  check.detail_mm = rmsOf(to - (similar * from.colwise().homogeneous()).topRows<3>());
  check.size_share = std::cbrt(similar.topLeftCorner<3, 3>().determinant()) - 1.0;
  check.sentence = formatted("%zu points of \"", check.points) + target.name +
                   formatted("\" were measured to %.3f mm; its size came out %+.3f %% off.",
                             check.error_mm, std::round(1e5 * check.size_share) / 1e3 + 0.0);
  return check;
}

std::pair<std::vector<TargetView>, std::vector<TargetView>> holdOut(
    std::span<const TargetView> views, int every_nth) {
  GYRE_CHECK(every_nth >= 2);
  std::pair<std::vector<TargetView>, std::vector<TargetView>> split;
  for (const TargetView& view : views) {
    TargetView kept = view;
    TargetView held = view;
    const auto is_held = [&](const PointSighting& s) { return s.point % every_nth == 0; };
    std::erase_if(kept.sightings, is_held);
    std::erase_if(held.sightings, [&](const PointSighting& s) { return !is_held(s); });
    split.first.push_back(std::move(kept));
    split.second.push_back(std::move(held));
  }
  return split;
}

Result<PlaceCheck> checkPlace(const RigCalibration& known, const TargetView& view,
                              const PlaceCheckOptions& options) {
  if (!(options.max_offset_px > 0.0)) {
    return Error{Error::Code::kInvalidInput, "The offset that counts as moved is not above zero.",
                 "Give it in pixels."};
  }
  RigBundleOptions any;
  const std::vector<TargetView> twice = {view, view};  // what is asked of a turn, of one picture
  if (auto valid = checkViews(twice, known.target, any); !valid) return valid.error();
  if (view.sightings.size() < 4 || !known.calibration.cam_from_table) {
    return Error{Error::Code::kTooFew,
                 "The picture \"" + view.name +
                     "\" shows too little of the target to check the "
                     "calibration.",
                 "Clear the view of it, or light it better."};
  }
  const RigScene scene = sceneOf(std::span(&view, 1), known.target, TargetShape::kExact);
  RigState state;
  state.frames = {known.calibration.camera, *known.calibration.cam_from_table,
                  known.table_from_target};
  state.angles_rad = {0.0};
  state.faces.assign(1, Eigen::Matrix<double, kFaceSize, 1>::Zero());
  PlaceCheck check;
  check.angle_rad = bestAngle(scene, state);
  const double squares = misfit(scene, state, check.angle_rad);
  check.offset_px = std::sqrt(squares / static_cast<double>(scene.sightings.size()));
  const double distance_mm = (state.frames.cam_from_base * known.table_from_target.translation).z();
  check.offset_mm = check.offset_px * distance_mm / state.frames.camera.fx;
  check.fits = check.offset_px <= options.max_offset_px;
  check.sentence =
      check.fits
          ? formatted("Camera and table stand as they were calibrated, to %.2f px (%.3f mm).",
                      check.offset_px, check.offset_mm)
          : formatted(
                "Camera or table were moved: the target is %.1f px (%.2f mm) off. One turn "
                "of the ring restores the camera's place, unless it was refocused or "
                "zoomed.",
                check.offset_px, check.offset_mm);
  return check;
}

}  // namespace gyre
