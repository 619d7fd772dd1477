// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_problem.h"

#include <exception>

#include <ceres/ceres.h>

namespace gyre {
namespace {

constexpr int kMostIterations = 100;

template <int kRows, int kColumns>
void store(const Eigen::Matrix<double, kRows, kColumns>& jacobian, double scale, double* out) {
  if (out == nullptr) return;
  using RowMajor =
      Eigen::Matrix<double, kRows, kColumns, kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::Map<RowMajor>{out} = scale * jacobian;
}

// (computed - seen) / sigma of one sighting.
class SightingCost final
    : public ceres::SizedCostFunction<2, kCameraSize, kAxisSize, kTargetSize, 1, kFaceSize, 1> {
 public:
  SightingCost(const RigFrames& frames, const FacePoint& point, const RigSighting& seen)
      : frames_(frames), point_(point), seen_(seen) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    RigParameters at;
    at.camera = Eigen::Map<const CameraVector>(blocks[0]);
    at.axis = Eigen::Map<const Eigen::Matrix<double, kAxisSize, 1>>(blocks[1]);
    at.target = Eigen::Map<const Eigen::Matrix<double, kTargetSize, 1>>(blocks[2]);
    at.angle_rad = *blocks[3];
    at.face = Eigen::Map<const Eigen::Matrix<double, kFaceSize, 1>>(blocks[4]);
    at.page_stretch = *blocks[5];
    Eigen::Vector2d pixel;
    RigJacobian by;
    if (!projectRig(frames_, at, point_, &pixel, jacobians == nullptr ? nullptr : &by)) {
      return false;
    }
    const double weight = 1.0 / seen_.sigma_px;
    Eigen::Map<Eigen::Vector2d>{residuals} = weight * (pixel - seen_.pixel);
    if (jacobians == nullptr) return true;
    store<2, kCameraSize>(by.camera, weight, jacobians[0]);
    store<2, kAxisSize>(by.axis, weight, jacobians[1]);
    store<2, kTargetSize>(by.target, weight, jacobians[2]);
    store<2, 1>(by.angle, weight, jacobians[3]);
    store<2, kFaceSize>(by.face, weight, jacobians[4]);
    store<2, 1>(by.page_stretch, weight, jacobians[5]);
    return true;
  }

 private:
  const RigFrames& frames_;
  const FacePoint& point_;
  const RigSighting& seen_;
};

// (angle - step scale * commanded) / sigma.
class AngleCost final : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  AngleCost(double commanded_rad, double sigma_rad)
      : commanded_rad_(commanded_rad), weight_(1.0 / sigma_rad) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = weight_ * (*blocks[0] - *blocks[1] * commanded_rad_);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) jacobians[0][0] = weight_;
    if (jacobians[1] != nullptr) jacobians[1][0] = -weight_ * commanded_rad_;
    return true;
  }

 private:
  double commanded_rad_;
  double weight_;
};

// parameter / sigma, for each of a block.
template <int kSize>
class ZeroCost final : public ceres::SizedCostFunction<kSize, kSize> {
 public:
  explicit ZeroCost(const Eigen::Matrix<double, kSize, 1>& sigmas)
      : weights_(sigmas.cwiseInverse()) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Vector = Eigen::Matrix<double, kSize, 1>;
    Eigen::Map<Vector>{residuals} = weights_.cwiseProduct(Eigen::Map<const Vector>(blocks[0]));
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      store<kSize, kSize>(weights_.asDiagonal().toDenseMatrix(), 1.0, jacobians[0]);
    }
    return true;
  }

 private:
  Eigen::Matrix<double, kSize, 1> weights_;
};

class StopOnRequest final : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const Task& task) : task_(task) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return task_.stopRequested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Task& task_;
};

// Holds the whole block, some of it, or nothing.
void hold(ceres::Problem& problem, double* block, const std::vector<int>& fixed) {
  if (!problem.HasParameterBlock(block) || fixed.empty()) return;
  const int size = problem.ParameterBlockSize(block);
  if (static_cast<int>(fixed.size()) == size) {
    problem.SetParameterBlockConstant(block);
  } else {
    problem.SetManifold(block, new ceres::SubsetManifold(size, fixed));
  }
}

std::vector<int> range(int from, int to) {
  std::vector<int> indices;
  for (int i = from; i < to; ++i) indices.push_back(i);
  return indices;
}

// Everything Ceres moves, in one place that stays where it is.
struct Blocks {
  CameraVector camera;
  Eigen::Matrix<double, kAxisSize, 1> axis = Eigen::Matrix<double, kAxisSize, 1>::Zero();
  Eigen::Matrix<double, kTargetSize, 1> target = Eigen::Matrix<double, kTargetSize, 1>::Zero();
};

void holdFixed(ceres::Problem& problem, const RigFreedom& freedom, Blocks& blocks,
               RigState& state) {
  std::vector<int> fixed;
  for (int i = 0; i < kCameraSize; ++i) {
    if (!freedom.camera[static_cast<std::size_t>(i)]) fixed.push_back(i);
  }
  hold(problem, blocks.camera.data(), fixed);
  if (!freedom.axis) hold(problem, blocks.axis.data(), range(0, kAxisSize));
  if (!freedom.target) hold(problem, blocks.target.data(), range(0, kTargetSize));
  hold(problem, state.angles_rad.data(), {0});
  for (std::size_t face = 0; face < state.faces.size(); ++face) {
    const bool stands = face + 1 == state.faces.size();
    std::vector<int> held;
    for (int i = 0; i < kFaceSize; ++i) {
      const bool free = i < 6 ? freedom.face_places : freedom.face_bows;
      if (stands || !free) held.push_back(i);
    }
    hold(problem, state.faces[face].data(), held);
  }
  if (!freedom.page_stretch) hold(problem, &state.page_stretch, {0});
  if (!freedom.step_scale) hold(problem, &state.step_scale, {0});
}

void addPriors(ceres::Problem& problem, const RigScene& scene, const RigPriors& priors,
               RigState& state) {
  for (std::size_t k = 1; k < scene.commanded_rad.size(); ++k) {
    if (!scene.commanded_rad[k]) continue;
    // A table that was moved by hand between two pictures must not bend the rest.
    problem.AddResidualBlock(new AngleCost(*scene.commanded_rad[k], priors.angle_rad),
                             new ceres::CauchyLoss(3.0), &state.angles_rad[k], &state.step_scale);
  }
  if (priors.folds) {
    for (auto& face : state.faces) {
      if (!problem.HasParameterBlock(face.data())) continue;
      problem.AddResidualBlock(new ZeroCost<kFaceSize>(priors.folds->sigmas()), nullptr,
                               face.data());
    }
  }
  if (problem.HasParameterBlock(&state.page_stretch)) {
    problem.AddResidualBlock(new ZeroCost<1>(Eigen::Matrix<double, 1, 1>(priors.page_stretch)),
                             nullptr, &state.page_stretch);
  }
}

// Takes the corrections into the frames they correct.
void settle(const Blocks& blocks, RigState& state) {
  RigFrames& frames = state.frames;
  frames.camera = cameraFrom(blocks.camera, frames.camera);
  const Rigid3 axis{rotationBy({blocks.axis[0], blocks.axis[1], 0.0}),
                    {blocks.axis[2], blocks.axis[3], 0.0}};
  frames.cam_from_base = frames.cam_from_base * axis;
  frames.table_from_target = frames.table_from_target *
                             Rigid3{rotationBy(blocks.target.head<3>()), blocks.target.tail<3>()};
}

Result<void> runSolver(ceres::Problem& problem, const Task& task) {
  ceres::Solver::Options options;
  options.max_num_iterations = kMostIterations;
  options.num_threads = 1;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  StopOnRequest stop(task);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (task.stopRequested()) return cancelled();
  if (summary.IsSolutionUsable()) return {};
  return Error{Error::Code::kTooFew, "The pictures of the target do not fix camera and axis.",
               "Take more pictures, with the target larger and turned all around."};
}

}  // namespace

Result<void> solveRig(const RigScene& scene, const RigSolve& solve, RigState& state,
                      const Task& task) {
  if (task.stopRequested()) return cancelled();
  try {
    Blocks blocks;
    blocks.camera = cameraVector(state.frames.camera);
    ceres::Problem problem;
    for (const RigSighting& seen : scene.sightings) {
      if (!seen.used) continue;
      ceres::LossFunction* loss =
          solve.loss_scale ? new ceres::CauchyLoss(*solve.loss_scale) : nullptr;
      problem.AddResidualBlock(new SightingCost(state.frames, scene.points[seen.point], seen), loss,
                               blocks.camera.data(), blocks.axis.data(), blocks.target.data(),
                               &state.angles_rad[seen.view],
                               state.faces[scene.face_of[seen.point]].data(), &state.page_stretch);
    }
    addPriors(problem, scene, solve.priors, state);
    holdFixed(problem, solve.freedom, blocks, state);
    if (auto solved = runSolver(problem, task); !solved) return solved;
    settle(blocks, state);
    return {};
  } catch (const std::exception& exception) {
    return Error{Error::Code::kInternal, "The calibration could not be solved.", exception.what()};
  }
}

}  // namespace gyre
