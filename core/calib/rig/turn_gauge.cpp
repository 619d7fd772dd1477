// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/turn_gauge.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace gyre {
namespace {

constexpr std::size_t kLeastPoints = 4;
constexpr int kSteps = 30;
constexpr double kHuber_px = 1.0;
constexpr double kMostMiss_px = 8.0;  // rms: more does not fit a turn, even with a wrong lens
constexpr double kLoseOut = 25.0;     // times the best guess's squares: never believed again
// Focal length over picture width: from a wide phone to a long lens.
constexpr double kLadder[] = {0.6, 0.8, 1.05, 1.4, 1.85, 2.45, 3.2, 4.3};

CameraModel roughCamera(const Eigen::Vector2i& size_px, double focal_over_width) {
  CameraModel camera;
  camera.width_px = size_px.x();
  camera.height_px = size_px.y();
  camera.fx = camera.fy = focal_over_width * std::max(size_px.x(), size_px.y());
  camera.cx = 0.5 * (size_px.x() - 1);
  camera.cy = 0.5 * (size_px.y() - 1);
  return camera;
}

// Whether the points lie in a plane, and a frame whose z is its normal.
struct Plane {
  Rigid3 plane_from_target;
  bool flat = false;
  bool a_line = false;
};

Plane planeOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) middle += point / static_cast<double>(points.size());
  Eigen::MatrixXd spread(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    spread.col(static_cast<Eigen::Index>(i)) = points[i] - middle;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(spread, Eigen::ComputeThinU);
  Plane plane;
  plane.flat = svd.singularValues()[2] < 0.02 * svd.singularValues()[0];
  plane.a_line = svd.singularValues()[1] < 0.02 * svd.singularValues()[0];
  Eigen::Matrix3d axes = svd.matrixU();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  plane.plane_from_target.rotation = axes.transpose();
  plane.plane_from_target.translation = -(axes.transpose() * middle);
  return plane;
}

Rigid3 rigidOf(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  cv::Mat matrix;
  cv::Rodrigues(rotation_vector, matrix);
  Rigid3 rigid;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rigid.rotation(row, column) = matrix.at<double>(row, column);
    }
    rigid.translation[row] = translation.at<double>(row);
  }
  return rigid;
}

// Every pose that explains the sightings: a plane seen from far allows two.
std::vector<Rigid3> posesOf(const CameraModel& camera, const std::vector<Eigen::Vector3d>& points,
                            const std::vector<cv::Point2d>& pixels) try {
  const Plane plane = planeOf(points);
  if (plane.a_line) return {};
  const Rigid3 local_from_target = plane.flat ? plane.plane_from_target : Rigid3{};
  std::vector<cv::Point3d> local;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d x = local_from_target * point;
    local.emplace_back(x.x(), x.y(), plane.flat ? 0.0 : x.z());
  }
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << camera.fx, 0.0, camera.cx, 0.0, camera.fy,
                          camera.cy, 0.0, 0.0, 1.0);
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::solvePnPGeneric(local, pixels, matrix, cv::noArray(), rotations, translations, false,
                      plane.flat ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
  std::vector<Rigid3> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    cv::solvePnPRefineLM(local, pixels, matrix, cv::noArray(), rotations[i], translations[i]);
    poses.push_back(rigidOf(rotations[i], translations[i]) * local_from_target);
  }
  return poses;
} catch (const cv::Exception&) {
  return {};
}

Rigid3 planarMotion(const Eigen::Vector3d& turn_and_shift) {
  Rigid3 motion;
  motion.rotation =
      Eigen::AngleAxisd(turn_and_shift[0], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  motion.translation = {turn_and_shift[1], turn_and_shift[2], 0.0};
  return motion;
}

double huberCost(double miss_px) {
  return miss_px < kHuber_px ? miss_px * miss_px : kHuber_px * (2.0 * miss_px - kHuber_px);
}

}  // namespace

Result<TurnGauge> TurnGauge::create(const Target& target, const TargetView& reference,
                                    const Eigen::Vector2i& picture_size_px) {
  TurnGauge gauge;
  gauge.points_ = pointsOf(target);
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Point2d> pixels;
  for (const PointSighting& seen : reference.sightings) {
    points.push_back(gauge.points_.at(static_cast<std::size_t>(seen.point)).position_in_target);
    pixels.emplace_back(seen.pixel.x(), seen.pixel.y());
  }
  if (points.size() >= kLeastPoints) {
    for (const double focal_over_width : kLadder) {
      const CameraModel camera = roughCamera(picture_size_px, focal_over_width);
      for (const Rigid3& pose : posesOf(camera, points, pixels)) {
        Guess guess{camera, pose, Eigen::Vector3d::Zero(), 0.0};
        if (const auto fit = gauge.fit(guess, reference)) {
          guess.squares_px2 = fit->squares_px2;
          gauge.guesses_.push_back(guess);
        }
      }
    }
  }
  if (gauge.guesses_.empty()) {
    return Error{Error::Code::kTooFew, "The picture shows too little of the target to measure by.",
                 "Place it so that the camera sees a whole face of it."};
  }
  return gauge;
}

// Gauss-Newton in three unknowns with Huber weights; slopes by differences.
std::optional<TurnGauge::Fit> TurnGauge::fit(const Guess& guess, const TargetView& view) const {
  const auto miss = [&](const Eigen::Vector3d& at, const PointSighting& seen) {
    const Eigen::Vector3d& x = points_[static_cast<std::size_t>(seen.point)].position_in_target;
    const auto pixel = guess.camera.project(guess.cam_from_target * (planarMotion(at) * x));
    return pixel ? std::optional<Eigen::Vector2d>(seen.pixel - *pixel) : std::nullopt;
  };
  if (view.sightings.size() < kLeastPoints) return std::nullopt;
  Fit fit{guess.turn_and_shift, 0.0, 0.0};
  Eigen::Matrix3d normal;
  for (int step = 0; step < kSteps; ++step) {
    normal.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    fit.squares_px2 = 0.0;
    for (const PointSighting& seen : view.sightings) {
      const auto here = miss(fit.turn_and_shift, seen);
      if (!here) return std::nullopt;
      Eigen::Matrix<double, 2, 3> slope;
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d aside = fit.turn_and_shift;
        const double by = k == 0 ? 1e-6 : 1e-4;
        aside[k] += by;
        const auto there = miss(aside, seen);
        if (!there) return std::nullopt;
        slope.col(k) = (*here - *there) / by;
      }
      const double length_px = here->norm();
      const double weight = length_px < kHuber_px ? 1.0 : kHuber_px / length_px;
      normal += weight * slope.transpose() * slope;
      right += weight * slope.transpose() * *here;
      fit.squares_px2 += huberCost(length_px);
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
    const Eigen::Vector3d change = solver.solve(right);
    fit.turn_and_shift += change;
    if (std::abs(change[0]) < 1e-8) break;
  }
  const auto freedom = 2.0 * static_cast<double>(view.sightings.size()) - 3.0;
  const Eigen::Matrix3d covariance = fit.squares_px2 / freedom * normal.inverse();
  fit.sigma_rad = std::sqrt(covariance(0, 0));
  return std::isfinite(fit.sigma_rad) ? std::optional<Fit>(fit) : std::nullopt;
}

std::optional<TurnReading> TurnGauge::read(const TargetView& view) {
  const Guess* best = nullptr;
  TurnReading reading;
  for (Guess& guess : guesses_) {
    const auto found = fit(guess, view);
    // A guess that cannot explain a picture loses its say without losing its place.
    guess.squares_px2 += found ? found->squares_px2 : 1e6;
    if (!found) continue;
    guess.turn_and_shift = found->turn_and_shift;
    if (best != nullptr && guess.squares_px2 >= best->squares_px2) continue;
    best = &guess;
    reading.angle_rad = found->turn_and_shift[0];
    reading.sigma_rad = found->sigma_rad;
    reading.rms_px = std::sqrt(found->squares_px2 / static_cast<double>(view.sightings.size()));
  }
  if (best == nullptr || reading.rms_px > kMostMiss_px) return std::nullopt;
  const double least = best->squares_px2 + 1.0;
  std::erase_if(guesses_, [&](const Guess& guess) { return guess.squares_px2 > kLoseOut * least; });
  return reading;
}

}  // namespace gyre
