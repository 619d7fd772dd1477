// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/tsai_depth.h"

#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace gyre {
namespace {

constexpr int kMostSteps = 50;

// One point's part in f, tz and kappa1: pixel offsets of equal scale, and the point turned and
// moved but for tz.
struct AlignedPoint {
  Eigen::Vector2d offset_px;
  Eigen::Vector3d in_cam_but_tz;
};

std::vector<AlignedPoint> alignedPoints(const RadialView& view) {
  std::vector<AlignedPoint> aligned;
  for (std::size_t i = 0; i < view.offsets_px.size(); ++i) {
    const Eigen::Vector2d& offset = view.offsets_px[i];
    aligned.push_back(
        {{offset.x() / view.aspect, offset.y()}, view.cam_from_target * view.points_in_target[i]});
  }
  return aligned;
}

struct FocalAndDepth {
  double focal_px = 0.0;
  double tz_mm = 0.0;
  double kappa1_per_px2 = 0.0;
};

// [ey, -yd] [f, tz]^T = yd w, the same along x: without distortion, linear.
std::optional<FocalAndDepth> solveLinear(const std::vector<AlignedPoint>& points) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const auto& [offset, e] : points) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d row(e[axis], -offset[axis]);
      normal += row * row.transpose();
      right += row * offset[axis] * e.z();
    }
  }
  const Eigen::FullPivLU<Eigen::Matrix2d> lu(normal);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Vector2d solution = lu.solve(right);
  return FocalAndDepth{solution[0], solution[1], 0.0};
}

struct NormalEquations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;
  bool in_front = true;
};

// On the undistorted picture a point misses by  f e / (w + tz) - d (1 + kappa1 r_d^2).
NormalEquations normalEquations(const std::vector<AlignedPoint>& points,
                                const FocalAndDepth& state) {
  NormalEquations equations;
  for (const auto& [offset, e] : points) {
    const double depth = e.z() + state.tz_mm;
    equations.in_front = equations.in_front && depth > 0.0;
    const double r2 = offset.squaredNorm();
    for (int axis = 0; axis < 2; ++axis) {
      const double ideal = e[axis] / depth;
      const double residual =
          state.focal_px * ideal - offset[axis] * (1.0 + state.kappa1_per_px2 * r2);
      const Eigen::Vector3d row(ideal, -state.focal_px * ideal / depth, -offset[axis] * r2);
      equations.hessian += row * row.transpose();
      equations.gradient += row * residual;
      equations.cost += residual * residual;
    }
  }
  return equations;
}

// Levenberg's method on f, tz and kappa1.
FocalAndDepth refineThree(const std::vector<AlignedPoint>& points, FocalAndDepth state) {
  NormalEquations here = normalEquations(points, state);
  double damping = 1e-4;
  for (int step = 0; step < kMostSteps && damping < 1e10; ++step) {
    Eigen::Matrix3d damped = here.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::Vector3d change = damped.ldlt().solve(-here.gradient);
    const FocalAndDepth next = {state.focal_px + change[0], state.tz_mm + change[1],
                                state.kappa1_per_px2 + change[2]};
    const NormalEquations there = normalEquations(points, next);
    if (!there.in_front || !(there.cost <= here.cost)) {
      damping *= 10.0;
      continue;
    }
    const bool settled = here.cost - there.cost <= 1e-14 * here.cost;
    state = next;
    here = there;
    damping *= 0.1;
    if (settled) break;
  }
  return state;
}

}  // namespace

Result<TsaiCamera> completeRadialView(const RadialView& view, const Eigen::Vector2d& principal_px) {
  const std::vector<AlignedPoint> points = alignedPoints(view);
  const auto linear = solveLinear(points);
  if (!linear || !std::isfinite(linear->focal_px) || !std::isfinite(linear->tz_mm)) {
    return undeterminedCamera();
  }
  if (!(linear->focal_px > 0.0) || !normalEquations(points, *linear).in_front)
    return mirroredPoints();
  const FocalAndDepth refined = refineThree(points, *linear);
  if (!(refined.focal_px > 0.0)) return mirroredPoints();
  TsaiCamera camera;
  camera.focal_px = refined.focal_px;
  camera.aspect = view.aspect;
  camera.principal_px = principal_px;
  camera.kappa1 = refined.kappa1_per_px2 * refined.focal_px * refined.focal_px;
  camera.cam_from_target = view.cam_from_target;
  camera.cam_from_target.translation.z() = refined.tz_mm;
  return camera;
}

Error undeterminedCamera() {
  return {Error::Code::kTooFew, "These points do not determine the camera.",
          "Use points that spread in all directions and fill more of the picture."};
}

Error mirroredPoints() {
  return {Error::Code::kInvalidInput,
          "The points only fit a mirrored picture, or one seen from behind.",
          "Check that X, Y, Z are right-handed and that u goes right and v goes down."};
}

}  // namespace gyre
