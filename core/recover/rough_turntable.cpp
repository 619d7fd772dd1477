// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/rough_turntable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <Eigen/Geometry>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/ray_intersection.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastMatches = 50;
constexpr double kLeastAgreeing = 0.2;
// So many matches choose among the starts, and so many tell the rest.
constexpr std::size_t kFewMatches = 400;
constexpr std::size_t kMostMatches = 8000;
constexpr int kFewIterations = 12;
constexpr int kManyIterations = 60;
constexpr std::size_t kFollowed = 4;  // of the best starts
// Focal lengths over the picture's longer side.
constexpr double kLeastFocal = 0.4;
constexpr double kMostFocal = 20.0;
constexpr double kLeastParallax_rad = 1e-3;

// Turn of the camera (3) from where it started, logarithm of the focal length.
constexpr int kUnknowns = 4;
using Unknowns = std::array<double, kUnknowns>;

struct Start {
  Eigen::Matrix3d cam_from_table;
  double step_rad;
  Unknowns unknowns{};
};

// Sampson's distance of a match, px.
class SampsonCost {
 public:
  SampsonCost(const Eigen::Matrix3d& start, const Eigen::Vector2d& middle, const TurnedMatch& match,
              double step_rad)
      : start_(start),
        first_(match.first_px - middle),
        second_(match.second_px - middle),
        turn_rad_(match.turn * step_rad) {}

  template <class T>
  bool operator()(const T* unknowns, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Matrix = Eigen::Matrix<T, 3, 3>;
    Matrix turned;
    ceres::AngleAxisToRotationMatrix(unknowns, turned.data());
    const Matrix cam_from_table = turned * start_.cast<T>();
    const T focal = exp(unknowns[3]);
    const T angle = T(turn_rad_);
    const T c = cos(angle);
    const T s = sin(angle);
    Matrix about_z;
    about_z << c, -s, T(0), s, c, T(0), T(0), T(0), T(1);
    const Matrix rotation = cam_from_table * about_z * cam_from_table.transpose();
    const Vector translation = cam_from_table * Vector(c - T(1), s, T(0));
    const Vector first(T(first_.x()) / focal, T(first_.y()) / focal, T(1));
    const Vector second(T(second_.x()) / focal, T(second_.y()) / focal, T(1));
    const Vector line_second = translation.cross(rotation * first);
    const Vector line_first = -(rotation.transpose() * translation.cross(second));
    const T slope =
        line_second.template head<2>().squaredNorm() + line_first.template head<2>().squaredNorm();
    residual[0] = focal * second.dot(line_second) / sqrt(slope + T(1e-20));
    return true;
  }

 private:
  const Eigen::Matrix3d& start_;
  Eigen::Vector2d first_;
  Eigen::Vector2d second_;
  double turn_rad_;
};

class Search {
 public:
  Search(std::span<const TurnedMatch> matches, const RoughTurntableOptions& options)
      : matches_(matches),
        options_(options),
        middle_(0.5 * (options.width_px - 1), 0.5 * (options.height_px - 1)),
        longer_px_(std::max(options.width_px, options.height_px)) {}

  double longerSide() const { return longer_px_; }

  // Improves the start; gives half the robust sum of squares over the number of matches.
  double solve(Start& start, std::size_t most, int iterations, bool hold_focal = false) const {
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    const std::size_t stride = matches_.size() / most + 1;
    ceres::CauchyLoss loss(options_.tolerance_px);
    std::size_t count = 0;
    for (std::size_t i = 0; i < matches_.size(); i += stride, ++count) {
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<SampsonCost, 1, kUnknowns>(
              new SampsonCost(start.cam_from_table, middle_, matches_[i], start.step_rad)),
          &loss, start.unknowns.data());
    }
    double* unknowns = start.unknowns.data();
    if (hold_focal) {
      problem.SetManifold(unknowns, new ceres::SubsetManifold(kUnknowns, {3}));
    } else {
      problem.SetParameterLowerBound(unknowns, 3, std::log(kLeastFocal * longer_px_));
      problem.SetParameterUpperBound(unknowns, 3, std::log(kMostFocal * longer_px_));
    }
    ceres::Solver::Options options;
    options.max_num_iterations = iterations;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = 1e-9;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return 1e300;
    return summary.final_cost / static_cast<double>(count);
  }

  RoughTurntable resultOf(const Start& start) const;

 private:
  std::span<const TurnedMatch> matches_;
  const RoughTurntableOptions& options_;
  Eigen::Vector2d middle_;
  double longer_px_;
};

RoughTurntable Search::resultOf(const Start& start) const {
  Eigen::Matrix3d turned;
  ceres::AngleAxisToRotationMatrix(start.unknowns.data(), turned.data());
  Eigen::Matrix3d rotation = turned * start.cam_from_table;
  double step_rad = start.step_rad;
  if (rotation(1, 2) > 0.0 && !options_.angles_known) {  // upside down
    rotation = rotation * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    step_rad = -step_rad;
  }
  RoughTurntable result;
  CameraModel& camera = result.calibration.camera;
  camera.width_px = options_.width_px;
  camera.height_px = options_.height_px;
  camera.fx = camera.fy = std::exp(start.unknowns[3]);
  camera.cx = middle_.x();
  camera.cy = middle_.y();
  const Rigid3 pose{rotation, -rotation.col(0)};  // the camera stands at (1, 0, 0)
  result.calibration.cam_from_table = pose;
  result.step_rad = step_rad;
  for (const TurnedMatch& match : matches_) {
    const Rigid3 second = camFromTable(pose, match.turn * step_rad);
    const auto spot = intersectTwoRays(
        rayThrough(pose, camera.normalizedFromPixel(match.first_px)),
        rayThrough(second, camera.normalizedFromPixel(match.second_px)), kLeastParallax_rad);
    if (!spot || spot->head<2>().norm() > 1.0) continue;
    const auto in_first = camera.project(pose * *spot);
    const auto in_second = camera.project(second * *spot);
    if (!in_first || !in_second) continue;
    const double off_px =
        std::max((*in_first - match.first_px).norm(), (*in_second - match.second_px).norm());
    if (off_px > options_.tolerance_px) continue;
    result.spots_in_table.push_back(*spot);
  }
  result.agreeing = result.spots_in_table.size();
  return result;
}

// Looks from so far above the table's plane at the axis, the axis upright in the picture or lying.
Eigen::Matrix3d lookAtAxis(double elevation_rad, double roll_rad) {
  const double c = std::cos(elevation_rad);
  const double s = std::sin(elevation_rad);
  Eigen::Matrix3d upright;
  upright << 0.0, 1.0, 0.0, s, 0.0, -c, -c, 0.0, -s;
  return Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * upright;
}

// Upside down and turning the other way is the same, unless the angles say which way it turns.
std::vector<Start> startsFor(const Search& search, const std::vector<double>& steps_rad,
                             bool angles_known) {
  const std::vector<double> rolls_deg =
      angles_known ? std::vector<double>{0.0, 90.0, 180.0, 270.0} : std::vector<double>{0.0, 90.0};
  std::vector<Start> starts;
  for (const double step_rad : steps_rad) {
    for (const double focal : {1.2, 4.0}) {
      for (const double elevation_deg : {-35.0, 0.0, 20.0, 50.0}) {
        for (const double roll_deg : rolls_deg) {
          starts.push_back({lookAtAxis(radFromDeg(elevation_deg), radFromDeg(roll_deg)),
                            step_rad,
                            {0.0, 0.0, 0.0, std::log(focal * search.longerSide())}});
        }
      }
    }
  }
  return starts;
}

struct Found {
  Start start;
  double cost = 1e300;
};

// The best of all starts, each followed a little, the best of them to the end.
Found best(const Search& search, std::vector<Start> starts, const Task& task) {
  std::vector<double> costs(starts.size());
  parallelFor(starts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !task.stopRequested(); ++i) {
      costs[i] = search.solve(starts[i], kFewMatches, kFewIterations);
    }
  });
  std::vector<std::size_t> order(starts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  Found found;
  for (std::size_t i = 0; i < std::min(kFollowed, order.size()); ++i) {
    if (task.stopRequested()) break;
    Start& start = starts[order[i]];
    const double cost = search.solve(start, kMostMatches, kManyIterations);
    if (cost < found.cost) found = {start, cost};
  }
  return found;
}

Error notTold() {
  return {Error::Code::kTooFew, "The pictures do not tell how camera and table stand.",
          "Give more pictures, with smaller steps, of an object with texture that fills the "
          "picture, or calibrate: gyre calibrate."};
}

}  // namespace

Result<RoughTurntable> roughTurntable(std::span<const TurnedMatch> matches,
                                      const RoughTurntableOptions& options, const Task& task) {
  if (matches.size() < kLeastMatches) return notTold();
  const Search search(matches, options);
  const std::vector<double> steps_rad =
      options.angles_known ? std::vector<double>{1.0}
                           : std::vector<double>{options.step_rad, -options.step_rad};
  const Found found = best(search, startsFor(search, steps_rad, options.angles_known), task);
  if (task.stopRequested()) return cancelled();
  RoughTurntable result = search.resultOf(found.start);
  if (static_cast<double>(result.agreeing) < kLeastAgreeing * static_cast<double>(matches.size())) {
    return notTold();
  }
  return result;
}

Result<Calibration> turnedCalibration(std::span<const TurnedMatch> matches,
                                      const Calibration& calibration, double tolerance_px,
                                      const Task& task) {
  if (matches.size() < kLeastMatches) return notTold();
  // As a camera without distortion, its axis through the middle, would have seen them.
  const CameraModel& camera = calibration.camera;
  RoughTurntableOptions options{camera.width_px, camera.height_px, true, 0.0, tolerance_px};
  const Eigen::Vector2d middle(0.5 * (options.width_px - 1), 0.5 * (options.height_px - 1));
  std::vector<TurnedMatch> ideal;
  ideal.reserve(matches.size());
  for (const TurnedMatch& match : matches) {
    ideal.push_back({camera.fx * camera.normalizedFromPixel(match.first_px) + middle,
                     camera.fx * camera.normalizedFromPixel(match.second_px) + middle, match.turn});
  }
  const Eigen::Vector3d centre = calibration.cam_from_table->inverse().translation;
  const Eigen::Matrix3d under_camera =
      Eigen::AngleAxisd(std::atan2(centre.y(), centre.x()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  Start start{calibration.cam_from_table->rotation * under_camera,
              1.0,
              {0.0, 0.0, 0.0, std::log(camera.fx)}};
  for (const double coarseness : {10.0, 1.0}) {
    if (task.stopRequested()) return cancelled();
    options.tolerance_px = coarseness * tolerance_px;
    Search(ideal, options).solve(start, kMostMatches, kManyIterations, true);
  }
  const RoughTurntable turned = Search(ideal, options).resultOf(start);
  if (static_cast<double>(turned.agreeing) < kLeastAgreeing * static_cast<double>(ideal.size())) {
    return notTold();
  }
  Calibration better = calibration;
  const Eigen::Matrix3d rotation =
      turned.calibration.cam_from_table->rotation * under_camera.transpose();
  better.cam_from_table = Rigid3{rotation, -(rotation * centre)};
  return better;
}

}  // namespace gyre
