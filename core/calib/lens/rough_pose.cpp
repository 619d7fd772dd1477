// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/rough_pose.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>

namespace gyre {
namespace {

constexpr int kMostSteps = 30;

int countOf(PoseFreedom freedom) {
  return freedom == PoseFreedom::kPose ? 6 : freedom == PoseFreedom::kFocal ? 7 : 8;
}

// The pose moved by a step: rotation vector, translation in shares of the distance, log of the
// focal length, k1.
RoughPose moved(const RoughPose& from, const Eigen::VectorXd& step) {
  RoughPose to = from;
  const Eigen::Vector3d turn = step.head<3>();
  const double angle_rad = turn.norm();
  if (angle_rad > 0.0) {
    to.cam_from_target.rotation =
        Eigen::AngleAxisd(angle_rad, turn / angle_rad) * from.cam_from_target.rotation;
  }
  to.cam_from_target.translation += step.segment<3>(3) * from.cam_from_target.translation.norm();
  if (step.size() > 6) {
    to.camera.fx *= std::exp(step[6]);
    to.camera.fy *= std::exp(step[6]);
  }
  if (step.size() > 7) to.camera.k1 += step[7];
  return to;
}

// Computed minus seen, or nothing when a point cannot be seen.
std::optional<Eigen::VectorXd> missesOf(std::span<const KnownPoint> points, const RoughPose& pose) {
  Eigen::VectorXd misses(2 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = pose.camera.project(pose.cam_from_target * points[i].position_in_target);
    if (!pixel) return std::nullopt;
    misses.segment<2>(2 * static_cast<Eigen::Index>(i)) = *pixel - points[i].pixel;
  }
  return misses;
}

std::optional<Eigen::MatrixXd> jacobianOf(std::span<const KnownPoint> points, const RoughPose& pose,
                                          const Eigen::VectorXd& misses, int count) {
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd jacobian(misses.size(), count);
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(count);
    step[k] = kStep;
    const auto beside = missesOf(points, moved(pose, step));
    if (!beside) return std::nullopt;
    jacobian.col(k) = (*beside - misses) / kStep;
  }
  return jacobian;
}

std::optional<RoughPose> poseFor(std::span<const KnownPoint> points, const CameraModel& camera) {
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> images;
  for (const KnownPoint& point : points) {
    const Eigen::Vector3d& x = point.position_in_target;
    const Eigen::Vector2d n = camera.normalizedFromPixel(point.pixel);
    objects.emplace_back(x.x(), x.y(), x.z());
    images.emplace_back(n.x(), n.y());
  }
  try {
    cv::Vec3d turn;
    cv::Vec3d shift;
    if (!cv::solvePnP(objects, images, cv::Matx33d::eye(), cv::noArray(), turn, shift, false,
                      cv::SOLVEPNP_SQPNP)) {
      return std::nullopt;
    }
    cv::Matx33d rotation;
    cv::Rodrigues(turn, rotation);
    RoughPose pose;
    pose.camera = camera;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) pose.cam_from_target.rotation(r, c) = rotation(r, c);
      pose.cam_from_target.translation[r] = shift[r];
    }
    if (!isRigid(pose.cam_from_target) || !pose.cam_from_target.translation.allFinite()) {
      return std::nullopt;
    }
    return pose;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<RoughPose> refineRoughPose(std::span<const KnownPoint> points, const RoughPose& start,
                                         PoseFreedom freedom) {
  const int count = countOf(freedom);
  if (2 * static_cast<int>(points.size()) < count) return std::nullopt;
  RoughPose pose = start;
  auto misses = missesOf(points, pose);
  if (!misses) return std::nullopt;
  double damping = 1e-4;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto jacobian = jacobianOf(points, pose, *misses, count);
    if (!jacobian) return std::nullopt;
    const Eigen::MatrixXd normal = jacobian->transpose() * *jacobian;
    const Eigen::VectorXd gradient = jacobian->transpose() * *misses;
    bool better = false;
    double gain = 0.0;
    for (int trial = 0; trial < 8 && !better; ++trial) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::VectorXd change = damped.ldlt().solve(-gradient);
      const auto next = change.allFinite() ? missesOf(points, moved(pose, change)) : std::nullopt;
      better = next && next->squaredNorm() < misses->squaredNorm();
      if (better) {
        gain = 1.0 - next->squaredNorm() / misses->squaredNorm();
        pose = moved(pose, change);
        misses = next;
      }
      damping = better ? std::max(1e-9, 0.2 * damping) : 10.0 * damping;
    }
    if (!better || gain < 1e-6) break;
  }
  pose.rms_px = std::sqrt(misses->squaredNorm() / static_cast<double>(points.size()));
  if (!std::isfinite(pose.rms_px)) return std::nullopt;
  return pose;
}

std::optional<RoughPose> findRoughPose(std::span<const KnownPoint> points,
                                       const CameraModel& camera, PoseFreedom freedom) {
  if (points.size() < 4) return std::nullopt;
  const std::array<double, 6> factors = {1.0, 0.5, 0.7, 1.5, 2.5, 5.0};
  const std::size_t trials = freedom == PoseFreedom::kPose ? 1 : factors.size();
  std::optional<RoughPose> best;
  for (std::size_t i = 0; i < trials; ++i) {
    CameraModel tried = camera;
    tried.fx *= factors[i];
    tried.fy *= factors[i];
    const auto start = poseFor(points, tried);
    if (!start) continue;
    const auto pose = refineRoughPose(points, *start, freedom);
    if (pose && (!best || pose->rms_px < best->rms_px)) best = pose;
  }
  return best;
}

CameraModel unknownCamera(int width_px, int height_px) {
  CameraModel camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx = camera.fy = 1.2 * std::max(width_px, height_px);
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  return camera;
}

}  // namespace gyre
