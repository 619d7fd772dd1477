// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/target_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace gyre {
namespace {

constexpr std::size_t kLeastPoints = 4;
constexpr int kRounds = 3;
constexpr double kFarOff = 4.0;  // times the median distance

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<Rigid3> poseThrough(const std::vector<cv::Point3d>& points,
                                  const std::vector<cv::Point2d>& normalized) {
  try {
    cv::Mat turn;
    cv::Mat shift;
    if (!cv::solvePnP(points, normalized, cv::Matx33d::eye(), cv::noArray(), turn, shift, false,
                      cv::SOLVEPNP_SQPNP)) {
      return std::nullopt;
    }
    cv::solvePnPRefineLM(points, normalized, cv::Matx33d::eye(), cv::noArray(), turn, shift);
    cv::Mat rotation;
    cv::Rodrigues(turn, rotation);
    Rigid3 cam_from_target;
    cv::cv2eigen(rotation, cam_from_target.rotation);
    cv::cv2eigen(shift, cam_from_target.translation);
    if (!isRigid(cam_from_target)) return std::nullopt;
    return cam_from_target;
  } catch (const cv::Exception&) {
    return std::nullopt;  // points on a line
  }
}

std::vector<double> distances(const CameraModel& camera, const Rigid3& cam_from_target,
                              const std::vector<KnownPoint>& points) {
  std::vector<double> off;
  for (const KnownPoint& point : points) {
    const auto pixel = camera.project(cam_from_target * point.position_in_target);
    off.push_back(pixel ? (*pixel - point.pixel).norm() : std::numeric_limits<double>::infinity());
  }
  return off;
}

}  // namespace

std::optional<TargetPose> targetPose(const CameraModel& camera,
                                     const std::vector<KnownPoint>& points) {
  std::vector<bool> kept(points.size(), true);
  std::optional<TargetPose> best;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<cv::Point3d> in_target;
    std::vector<cv::Point2d> normalized;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!kept[i]) continue;
      const Eigen::Vector3d& x = points[i].position_in_target;
      const Eigen::Vector2d n = camera.normalizedFromPixel(points[i].pixel);
      in_target.emplace_back(x.x(), x.y(), x.z());
      normalized.emplace_back(n.x(), n.y());
    }
    if (in_target.size() < kLeastPoints) break;
    const auto pose = poseThrough(in_target, normalized);
    if (!pose) break;
    const std::vector<double> off = distances(camera, *pose, points);
    const double median_px = median(off);
    if (!std::isfinite(median_px)) break;
    if (best && median_px >= best->median_px) break;
    best = TargetPose{*pose, median_px};
    bool dropped = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      kept[i] = off[i] <= kFarOff * median_px + 1e-9;
      dropped = dropped || !kept[i];
    }
    if (!dropped) break;
  }
  return best;
}

}  // namespace gyre
