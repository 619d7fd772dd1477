// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/track_gates.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

// A live point this far off in its own standard deviations is lost: hidden, or slipped.
constexpr double kLostSigma = 6.0;
// What has not left this circle while the table turned this far stands in the room.
constexpr double kStill_px = 0.7;
constexpr double kTurnToTell_rad = 0.12;

}  // namespace

cv::Mat allowedArea(const cv::Mat& object_mask, const TrackOptions& options) {
  const cv::Mat object = object_mask != 0;
  cv::Mat distance;
  cv::distanceTransform(object, distance, cv::DIST_L2, 3);
  cv::Mat allowed = distance > options.silhouette_margin_px;
  // The picture's edge cuts the object off; what lies beyond it is unknown.
  const int edge = options.window_px / 2 + 2;
  const cv::Rect picture(0, 0, allowed.cols, allowed.rows);
  const cv::Rect middle(edge, edge, allowed.cols - 2 * edge, allowed.rows - 2 * edge);
  cv::Mat framed = cv::Mat::zeros(allowed.size(), CV_8U);
  const cv::Rect kept = middle & picture;
  if (!kept.empty()) allowed(kept).copyTo(framed(kept));
  return framed;
}

bool fitsTurning(const ViewGeometry& view, std::size_t sightings_before, const Sighting& latest,
                 const EstimatedPoint& point, const TrackOptions& options) {
  const Eigen::Vector3d& x = point.position_in_table;
  if (x.head<2>().norm() > view.volume.radius_mm || x.z() > view.volume.z_max_mm) return false;
  const Eigen::Vector3d in_cam = view.cam_from_table * x;
  const double off = (latest.normalized - in_cam.head<2>() / in_cam.z()).norm();
  const double off_px = off * std::sqrt(view.camera.fx * view.camera.fy);
  // The middle of two rays is half their distance from either.
  if (sightings_before < 3) return off_px <= 0.5 * options.max_epipolar_px;
  const double z_sigma = std::sqrt(point.covariance(2, 2));
  if (x.z() + 2.0 * z_sigma < options.min_height_mm) return false;
  return off_px <= options.max_epipolar_px && off <= kLostSigma * latest.sigma;
}

bool standsStill(const Track& track, double turned_rad) {
  if (std::abs(turned_rad) < kTurnToTell_rad) return false;
  const Eigen::Vector2d& first = track.observations.front().pixel;
  for (const Observation& seen : track.observations) {
    if ((seen.pixel - first).squaredNorm() > kStill_px * kStill_px) return false;
  }
  return true;
}

}  // namespace gyre
