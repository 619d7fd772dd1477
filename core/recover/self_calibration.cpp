// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/self_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr std::size_t kLeastTracks = 50;
constexpr std::size_t kMostTracks = 4000;
constexpr double kCauchy_sigma = 2.385;
constexpr double kAgrees_sigma = 3.0;

// Turn of the camera (3), logarithm of the change of focal length, change of k1 and of the
// principal point (2, px).
constexpr int kCameraUnknowns = 7;
constexpr int kFocal = 3;
constexpr int kK1 = 4;
constexpr int kCentre = 5;

struct Rig {
  CameraModel camera;
  Eigen::Matrix3d rotation;        // cam_from_table at angle 0
  Eigen::Vector3d centre_in_base;  // of the camera, mm
};

// (computed - seen) / sigma of one sighting.
struct SightingCost {
  const Rig& rig;
  Observation seen;

  template <class T>
  bool operator()(const T* change, const T* angle_rad, const T* point, T* residuals) const {
    const T c = cos(*angle_rad);
    const T s = sin(*angle_rad);
    const Eigen::Matrix<T, 3, 1> from_centre(c * point[0] - s * point[1] - rig.centre_in_base.x(),
                                             s * point[0] + c * point[1] - rig.centre_in_base.y(),
                                             point[2] - rig.centre_in_base.z());
    const Eigen::Matrix<T, 3, 1> before = rig.rotation.cast<T>() * from_centre;
    T in_cam[3];
    ceres::AngleAxisRotatePoint(change, before.data(), in_cam);
    if (in_cam[2] <= T(1e-9)) return false;
    const T x = in_cam[0] / in_cam[2];
    const T y = in_cam[1] / in_cam[2];
    const CameraModel& camera = rig.camera;
    const T r2 = x * x + y * y;
    const T radial =
        T(1.0) + r2 * (T(camera.k1) + change[kK1] + r2 * (T(camera.k2) + r2 * T(camera.k3)));
    const T bent_x = x * radial + 2.0 * camera.p1 * x * y + camera.p2 * (r2 + 2.0 * x * x);
    const T bent_y = y * radial + camera.p1 * (r2 + 2.0 * y * y) + 2.0 * camera.p2 * x * y;
    const T scale = exp(change[kFocal]);
    const T u = scale * (camera.fx * bent_x + camera.skew * bent_y) + camera.cx + change[kCentre];
    const T v = scale * camera.fy * bent_y + camera.cy + change[kCentre + 1];
    residuals[0] = (u - seen.pixel.x()) / seen.sigma_px;
    residuals[1] = (v - seen.pixel.y()) / seen.sigma_px;
    return true;
  }
};

// A number that is known to a standard deviation.
struct PriorCost {
  double expected;
  double sigma;
  int index;

  template <class T>
  bool operator()(const T* values, T* residual) const {
    residual[0] = (values[index] - expected) / sigma;
    return true;
  }
};

class StopCallback final : public ceres::IterationCallback {
 public:
  StopCallback(const Task& task, int most) : task_(task), most_(most) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    task_.report(static_cast<double>(summary.iteration) / most_, "Solving camera and axis");
    return task_.stopRequested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Task& task_;
  int most_;
};

// The problem owns its costs, but not the loss that they share.
ceres::Problem::Options ownCosts() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

class Adjustment {
 public:
  Adjustment(std::span<const PixelTrack> tracks, const Calibration& calibration,
             const ViewAngles& angles)
      : rig_{calibration.camera, calibration.cam_from_table->rotation,
             calibration.cam_from_table->inverse().translation},
        angles_rad_(angles.start_rad) {
    const std::size_t stride = tracks.size() / kMostTracks + 1;
    for (std::size_t i = 0; i < tracks.size(); i += stride) {
      tracks_.push_back(&tracks[i]);
      points_.push_back(tracks[i].position_in_table);
    }
  }

  void build(const ViewAngles& angles, const SelfCalibrationOptions& options);
  Result<void> solve(const SelfCalibrationOptions& options, const Task& task);
  // Root of the mean squared distances [px] of the sightings within the gate at the end.
  double rms(const std::vector<char>& agrees) const;
  std::vector<char> agreeing() const;
  double focalSigmaPx() const;
  Calibration calibration() const;
  const std::vector<double>& anglesRad() const { return angles_rad_; }

 private:
  template <class Visit>
  void eachOff(const Visit& visit) const;

  Rig rig_;
  std::vector<const PixelTrack*> tracks_;
  std::array<double, kCameraUnknowns> change_{};
  std::vector<double> angles_rad_;
  std::vector<Eigen::Vector3d> points_;
  ceres::CauchyLoss loss_{kCauchy_sigma};
  mutable ceres::Problem problem_{ownCosts()};
};

void Adjustment::build(const ViewAngles& angles, const SelfCalibrationOptions& options) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (const Observation& seen : tracks_[i]->observations) {
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<SightingCost, 2, kCameraUnknowns, 1, 3>(
              new SightingCost{rig_, seen}),
          &loss_, change_.data(), &angles_rad_[static_cast<std::size_t>(seen.view)],
          points_[i].data());
    }
  }
  const auto prior = [&](double* values, int index, double expected, double sigma) {
    if (values == change_.data()) {
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost, 1, kCameraUnknowns>(
                                    new PriorCost{expected, sigma, index}),
                                nullptr, values);
    } else {
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<PriorCost, 1, 1>(new PriorCost{expected, sigma, index}),
          nullptr, values);
    }
  };
  prior(change_.data(), kFocal, 0.0, options.focal_share);
  prior(change_.data(), kK1, 0.0, options.k1);
  prior(change_.data(), kCentre, 0.0, options.centre_px);
  prior(change_.data(), kCentre + 1, 0.0, options.centre_px);
  for (std::size_t view = 0; view < angles_rad_.size(); ++view) {
    prior(&angles_rad_[view], 0, angles.told_rad[view], options.angle_rad);
  }
  // The picture at angle 0 fixes the table's frame.
  const auto at_zero = static_cast<std::size_t>(
      std::min_element(angles.told_rad.begin(), angles.told_rad.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      angles.told_rad.begin());
  angles_rad_[at_zero] = angles.told_rad[at_zero];
  problem_.SetParameterBlockConstant(&angles_rad_[at_zero]);
}

Result<void> Adjustment::solve(const SelfCalibrationOptions& options, const Task& task) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.max_num_iterations = options.most_steps;
  solver.num_threads = 1;  // sums in one order: the same result on every machine
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  for (Eigen::Vector3d& point : points_) order->AddElementToGroup(point.data(), 0);
  for (double& angle : angles_rad_) order->AddElementToGroup(&angle, 1);
  order->AddElementToGroup(change_.data(), 1);
  solver.linear_solver_ordering = order;
  StopCallback stop(task, options.most_steps);
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem_, &summary);
  if (task.stopRequested()) return cancelled();
  if (!summary.IsSolutionUsable()) {
    return Error{Error::Code::kInternal, "Camera and axis could not be told from the object.",
                 "Calibrate instead: gyre calibrate."};
  }
  return {};
}

template <class Visit>
void Adjustment::eachOff(const Visit& visit) const {
  std::size_t index = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (const Observation& seen : tracks_[i]->observations) {
      Eigen::Vector2d off = Eigen::Vector2d::Constant(1e9);
      SightingCost{rig_, seen}(change_.data(), &angles_rad_[static_cast<std::size_t>(seen.view)],
                               points_[i].data(), off.data());
      visit(index++, off, seen.sigma_px);
    }
  }
}

std::vector<char> Adjustment::agreeing() const {
  std::vector<char> agrees;
  eachOff([&](std::size_t, const Eigen::Vector2d& off, double) {
    agrees.push_back(off.norm() < kAgrees_sigma ? 1 : 0);
  });
  return agrees;
}

double Adjustment::rms(const std::vector<char>& agrees) const {
  double squares = 0.0;
  std::size_t count = 0;
  eachOff([&](std::size_t index, const Eigen::Vector2d& off, double sigma_px) {
    if (agrees[index] == 0) return;
    squares += off.squaredNorm() * sigma_px * sigma_px;
    ++count;
  });
  return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
}

double Adjustment::focalSigmaPx() const {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  ceres::Covariance covariance(options);
  const std::vector<const double*> camera{change_.data()};
  if (!covariance.Compute(camera, &problem_)) return 0.0;
  Eigen::Matrix<double, kCameraUnknowns, kCameraUnknowns, Eigen::RowMajor> block;
  covariance.GetCovarianceBlock(change_.data(), change_.data(), block.data());
  return std::sqrt(block(kFocal, kFocal)) * rig_.camera.fx * std::exp(change_[kFocal]);
}

Calibration Adjustment::calibration() const {
  Calibration better{rig_.camera, std::nullopt};
  const double scale = std::exp(change_[kFocal]);
  better.camera.fx *= scale;
  better.camera.fy *= scale;
  better.camera.skew *= scale;
  better.camera.k1 += change_[kK1];
  better.camera.cx += change_[kCentre];
  better.camera.cy += change_[kCentre + 1];
  Eigen::Matrix3d turned;
  ceres::AngleAxisToRotationMatrix(change_.data(), turned.data());
  const Eigen::Matrix3d rotation = turned * rig_.rotation;
  better.cam_from_table = Rigid3{rotation, -(rotation * rig_.centre_in_base)};
  return better;
}

}  // namespace

Result<SelfCalibration> selfCalibrate(std::span<const PixelTrack> tracks,
                                      const Calibration& calibration, const ViewAngles& angles,
                                      const SelfCalibrationOptions& options, const Task& task) {
  if (tracks.size() < kLeastTracks) {
    return Error{Error::Code::kTooFew, "Too few points to tell camera and axis from the object.",
                 "Give more pictures of an object with texture, or calibrate: gyre calibrate."};
  }
  Adjustment adjustment(tracks, calibration, angles);
  adjustment.build(angles, options);
  const Adjustment before(tracks, calibration, angles);
  if (auto solved = adjustment.solve(options, task); !solved) return solved.error();
  SelfCalibration result;
  const std::vector<char> agrees = adjustment.agreeing();
  result.rms_before_px = before.rms(agrees);
  result.rms_after_px = adjustment.rms(agrees);
  result.calibration = adjustment.calibration();
  result.angles_rad = adjustment.anglesRad();
  result.focal_sigma_px = adjustment.focalSigmaPx();
  return result;
}

}  // namespace gyre
