// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/refine_camera.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace gyre {
namespace {

// What is solved for: fy and fx / fy instead of both, so that their ratio can be held.
enum Unknown { kFocal, kAspect, kShear, kU0, kV0, kR1, kR2, kT1, kT2, kR3, kUnknowns };
using Intrinsics = std::array<double, kUnknowns>;
// A turn (angle axis) applied before the start's rotation, then the translation: near zero turns
// have no singularity.
using Pose = std::array<double, 6>;
using IntrinsicsCovariance = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr int kMostIterations = 200;
// Of the normal matrix with a diagonal of ones: below it, rounding decides.
constexpr double kLeastCondition = 1e-14;

Intrinsics intrinsicsOf(const CameraModel& camera) {
  return {camera.fy,   camera.fx / camera.fy,
          camera.skew, camera.cx,
          camera.cy,   camera.k1,
          camera.k2,   camera.p1,
          camera.p2,   camera.k3};
}

CameraModel cameraOf(const Intrinsics& unknowns, const CameraModel& start) {
  CameraModel camera = start;
  camera.fy = unknowns[kFocal];
  camera.fx = unknowns[kFocal] * unknowns[kAspect];
  camera.skew = unknowns[kShear];
  camera.cx = unknowns[kU0];
  camera.cy = unknowns[kV0];
  camera.k1 = unknowns[kR1];
  camera.k2 = unknowns[kR2];
  camera.p1 = unknowns[kT1];
  camera.p2 = unknowns[kT2];
  camera.k3 = unknowns[kR3];
  return camera;
}

Rigid3 rigidOf(const Pose& pose, const Rigid3& start) {
  const Eigen::Vector3d turn(pose[0], pose[1], pose[2]);
  const double angle_rad = turn.norm();
  const Eigen::Vector3d axis = angle_rad > 0.0 ? Eigen::Vector3d(turn / angle_rad)
                                               : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  Rigid3 cam_from_target;
  cam_from_target.rotation = Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix() * start.rotation;
  cam_from_target.translation = {pose[3], pose[4], pose[5]};
  return cam_from_target;
}

// One sighting: computed minus seen over sigma.
class Reprojection {
 public:
  Reprojection(const KnownPoint& point, const Rigid3& start)
      : turned_(start.rotation * point.position_in_target),
        pixel_(point.pixel),
        sigma_px_(point.sigma_px) {}

  template <class T>
  bool operator()(const T* k, const T* pose, T* residual) const {
    const T turned[3] = {T(turned_.x()), T(turned_.y()), T(turned_.z())};
    T in_cam[3];
    ceres::AngleAxisRotatePoint(pose, turned, in_cam);
    for (int i = 0; i < 3; ++i) in_cam[i] += pose[3 + i];
    if (!(in_cam[2] > T(0.0))) return false;
    const T x = in_cam[0] / in_cam[2];
    const T y = in_cam[1] / in_cam[2];
    const T r2 = x * x + y * y;
    const T radial = T(1.0) + r2 * (k[kR1] + r2 * (k[kR2] + r2 * k[kR3]));
    const T x_distorted = x * radial + T(2.0) * k[kT1] * x * y + k[kT2] * (r2 + T(2.0) * x * x);
    const T y_distorted = y * radial + k[kT1] * (r2 + T(2.0) * y * y) + T(2.0) * k[kT2] * x * y;
    const T u = k[kFocal] * k[kAspect] * x_distorted + k[kShear] * y_distorted + k[kU0];
    const T v = k[kFocal] * y_distorted + k[kV0];
    residual[0] = (u - pixel_.x()) / sigma_px_;
    residual[1] = (v - pixel_.y()) / sigma_px_;
    return true;
  }

 private:
  Eigen::Vector3d turned_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

class StopWhenAsked final : public ceres::IterationCallback {
 public:
  explicit StopWhenAsked(const Task& task) : task_(task) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return task_.stopRequested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Task& task_;
};

std::vector<int> heldUnknowns(const RefineOptions& options) {
  std::vector<int> held;
  if (!options.free_aspect) held.push_back(kAspect);
  if (!options.free_skew) held.push_back(kShear);
  if (!options.free_principal) {
    held.push_back(kU0);
    held.push_back(kV0);
  }
  if (!options.free_k1) held.push_back(kR1);
  if (!options.free_k2) held.push_back(kR2);
  if (!options.free_tangential) {
    held.push_back(kT1);
    held.push_back(kT2);
  }
  if (!options.free_k3) held.push_back(kR3);
  return held;
}

Error undetermined() {
  return {Error::Code::kTooFew, "These pictures do not determine the camera.",
          "Take more views, with the target tilted in different directions and near the corners of "
          "the picture."};
}

bool isUsable(const KnownPoint& point) {
  return point.position_in_target.allFinite() && point.pixel.allFinite() &&
         std::isfinite(point.sigma_px) && point.sigma_px > 0.0;
}

Result<void> checkInput(const CameraModel& start, const std::vector<CameraView>& views,
                        std::size_t free_unknowns) {
  std::size_t equations = 0;
  bool usable = start.fx > 0.0 && start.fy > 0.0;
  for (const double number : intrinsicsOf(start)) usable = usable && std::isfinite(number);
  bool in_front = true;
  for (const CameraView& view : views) {
    usable = usable && isRigid(view.cam_from_target);
    equations += 2 * view.points.size();
    for (const KnownPoint& point : view.points) {
      usable = usable && isUsable(point);
      in_front = in_front && (view.cam_from_target * point.position_in_target).z() > 0.0;
    }
  }
  if (!usable) {
    return Error{Error::Code::kInvalidInput, "A number given to the calibration is not usable.",
                 "Check the coordinates of the target and of its sightings."};
  }
  if (equations < free_unknowns + 6 * views.size() || equations == 0) {
    return Error{Error::Code::kTooFew, "Too few points were seen to find the camera.",
                 "Show more of the target, or more views of it."};
  }
  if (!in_front) {
    return Error{Error::Code::kInvalidInput, "A point of the target lies behind the camera.",
                 "Check that the coordinates of the target are right-handed."};
  }
  return {};
}

// J^T J
Eigen::MatrixXd normalMatrix(const ceres::CRSMatrix& jacobian) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (std::size_t row = 0; row + 1 < jacobian.rows.size(); ++row) {
    for (int a = jacobian.rows[row]; a < jacobian.rows[row + 1]; ++a) {
      for (int b = jacobian.rows[row]; b < jacobian.rows[row + 1]; ++b) {
        const auto i = static_cast<std::size_t>(a);
        const auto k = static_cast<std::size_t>(b);
        normal(jacobian.cols[i], jacobian.cols[k]) += jacobian.values[i] * jacobian.values[k];
      }
    }
  }
  return normal;
}

// The whole problem, whose parameters live here while Ceres works on them.
class RefineProblem {
 public:
  RefineProblem(const CameraModel& start, const std::vector<CameraView>& views,
                const RefineOptions& options)
      : start_(start), views_(views), intrinsics_(intrinsicsOf(start)), poses_(views.size()) {
    problem_.AddParameterBlock(intrinsics_.data(), kUnknowns);
    const std::vector<int> held = heldUnknowns(options);
    for (int i = 0; i < kUnknowns; ++i) {
      if (std::find(held.begin(), held.end(), i) == held.end()) free_.push_back(i);
    }
    if (!held.empty()) {
      problem_.SetManifold(intrinsics_.data(), new ceres::SubsetManifold(kUnknowns, held));
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      const Eigen::Vector3d& t = views[v].cam_from_target.translation;
      poses_[v] = {0.0, 0.0, 0.0, t.x(), t.y(), t.z()};
      for (const KnownPoint& point : views[v].points) {
        using Cost = ceres::AutoDiffCostFunction<Reprojection, 2, kUnknowns, 6>;
        ceres::LossFunction* loss =
            options.cauchy_sigma > 0.0 ? new ceres::CauchyLoss(options.cauchy_sigma) : nullptr;
        problem_.AddResidualBlock(new Cost(new Reprojection(point, views[v].cam_from_target)), loss,
                                  intrinsics_.data(), poses_[v].data());
      }
    }
  }

  bool solve(const Task& task) {
    StopWhenAsked stop(task);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = kMostIterations;
    options.function_tolerance = 1e-14;
    options.parameter_tolerance = 1e-12;
    options.gradient_tolerance = 1e-12;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  // Of the free intrinsics, for sightings of exactly their sigma; zero where held. Nothing when the
  // sightings do not determine all that is free.
  std::optional<IntrinsicsCovariance> covariance() {
    ceres::CRSMatrix jacobian;
    if (!problem_.Evaluate({}, nullptr, nullptr, nullptr, &jacobian)) return std::nullopt;
    // The first columns are the free intrinsics, for their block was added first.
    Eigen::MatrixXd normal = normalMatrix(jacobian);
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt();
    if (!(scale.minCoeff() > 0.0)) return std::nullopt;
    normal = scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(normal);
    if (ldlt.info() != Eigen::Success || !(ldlt.rcond() > kLeastCondition)) return std::nullopt;
    const Eigen::Index size = normal.rows();
    const auto free_count = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd inverse = ldlt.solve(Eigen::MatrixXd::Identity(size, free_count));
    inverse = scale.cwiseInverse().asDiagonal() * inverse;
    IntrinsicsCovariance result = IntrinsicsCovariance::Zero();
    for (Eigen::Index i = 0; i < free_count; ++i) {
      for (Eigen::Index k = 0; k < free_count; ++k) {
        result(free_[static_cast<std::size_t>(i)], free_[static_cast<std::size_t>(k)]) =
            inverse(i, k) / scale[k];
      }
    }
    return result;
  }

  RefinedCamera result() const {
    RefinedCamera refined;
    refined.camera = cameraOf(intrinsics_, start_);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      refined.cam_from_target.push_back(rigidOf(poses_[v], views_[v].cam_from_target));
    }
    return refined;
  }

 private:
  const CameraModel& start_;
  const std::vector<CameraView>& views_;
  Intrinsics intrinsics_;
  std::vector<Pose> poses_;
  std::vector<int> free_;
  ceres::Problem problem_;
};

// Residuals and rms; returns the sum of squares in units of sigma.
double measureResiduals(const std::vector<CameraView>& views, RefinedCamera& refined) {
  double squares_px = 0.0;
  double chi2 = 0.0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<Eigen::Vector2d>& residuals = refined.residuals_px.emplace_back();
    for (const KnownPoint& point : views[v].points) {
      const Eigen::Vector3d in_cam = refined.cam_from_target[v] * point.position_in_target;
      const Eigen::Vector2d computed = refined.camera.pixelFromNormalized(in_cam.hnormalized());
      residuals.emplace_back(point.pixel - computed);
      squares_px += residuals.back().squaredNorm();
      chi2 += residuals.back().squaredNorm() / (point.sigma_px * point.sigma_px);
      ++count;
    }
  }
  refined.rms_px = std::sqrt(squares_px / static_cast<double>(count));
  return chi2;
}

// fx = fy aspect, the rest as it is.
CameraCovariance cameraCovariance(const IntrinsicsCovariance& unknowns, const CameraModel& camera) {
  CameraCovariance camera_from_unknowns = CameraCovariance::Identity();
  camera_from_unknowns(kFx, kFocal) = camera.fx / camera.fy;
  camera_from_unknowns(kFx, kAspect) = camera.fy;
  camera_from_unknowns(kFy, kFocal) = 1.0;
  camera_from_unknowns(kFy, kAspect) = 0.0;
  return camera_from_unknowns * unknowns * camera_from_unknowns.transpose();
}

Result<RefinedCamera> refine(const CameraModel& start, const std::vector<CameraView>& views,
                             const RefineOptions& options, const Task& task) {
  const std::size_t free_unknowns = kUnknowns - heldUnknowns(options).size();
  if (auto valid = checkInput(start, views, free_unknowns); !valid) return valid.error();
  RefineProblem problem(start, views, options);
  const bool solved = problem.solve(task);
  if (task.stopRequested()) return cancelled();
  if (!solved) return undetermined();
  RefinedCamera refined = problem.result();
  if (!(refined.camera.fx > 0.0) || !(refined.camera.fy > 0.0)) return undetermined();
  const double chi2 = measureResiduals(views, refined);
  const auto covariance = problem.covariance();
  if (!covariance) return undetermined();
  std::size_t equations = 0;
  for (const CameraView& view : views) equations += 2 * view.points.size();
  const std::size_t unknowns = free_unknowns + 6 * views.size();
  const double freedom = static_cast<double>(std::max<std::size_t>(equations - unknowns, 1));
  refined.covariance = chi2 / freedom * cameraCovariance(*covariance, refined.camera);
  return refined;
}

}  // namespace

Result<RefinedCamera> refineCamera(const CameraModel& start, const std::vector<CameraView>& views,
                                   const RefineOptions& options, const Task& task) {
  try {
    return refine(start, views, options, task);
  } catch (const std::exception& problem) {
    return Error{Error::Code::kInternal, std::string("The solver failed: ") + problem.what() + ".",
                 ""};
  }
}

}  // namespace gyre
