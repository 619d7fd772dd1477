// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/calibrate_hand_held.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

#include "core/calib/corners/point_spread.h"
#include "core/calib/lens/fit_report.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastPoints = 6;
constexpr int kOutlierRounds = 3;
constexpr double kCauchy_sigma = 3.0;
constexpr double kSure_sigma = 5.0;
constexpr double kMostFocalSigma = 0.01;  // of the focal length
// Exact sightings have no spread: nothing this near is an outlier.
constexpr double kLeastSpread_px = 0.02;
constexpr double kMedianOfLength = 1.1774;  // of a 2-D normal error, in its standard deviations

// A view that takes part, and where its points come from.
struct Candidate {
  int view = 0;
  CameraView seen;
  std::vector<int> points;  // index into pointsOf(target), one a seen point
  std::vector<int> faces;
};

Result<std::vector<Candidate>> candidatesOf(const Target& target,
                                            std::span<const TargetView> views) {
  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<Candidate> candidates;
  for (std::size_t v = 0; v < views.size(); ++v) {
    Candidate candidate;
    candidate.view = static_cast<int>(v);
    for (const PointSighting& sighting : views[v].sightings) {
      if (sighting.point < 0 || static_cast<std::size_t>(sighting.point) >= points.size() ||
          !sighting.pixel.allFinite() || !(sighting.sigma_px > 0.0)) {
        return Error{Error::Code::kInvalidInput,
                     "The sightings of \"" + views[v].name + "\" do not belong to this target.",
                     "Detect the corners again with the target that is in the pictures."};
      }
      const TargetPoint& point = points[static_cast<std::size_t>(sighting.point)];
      candidate.seen.points.push_back(
          {point.position_in_target, sighting.pixel, sighting.sigma_px});
      candidate.points.push_back(sighting.point);
      candidate.faces.push_back(point.face);
    }
    if (candidate.points.size() >= kLeastPoints) candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) {
    return Error{Error::Code::kTooFew, "No picture shows enough of the target.",
                 "Show at least six of its corners, sharp and well lit, in several pictures."};
  }
  return candidates;
}

// The part of a view on one face, flat: in the plane of the face, z = 0.
struct FlatViews {
  std::vector<std::vector<cv::Point3f>> places;
  std::vector<std::vector<cv::Point2f>> pixels;
};

void addFlatViews(const Candidate& candidate, FlatViews& flat) {
  const int faces = 1 + *std::max_element(candidate.faces.begin(), candidate.faces.end());
  for (int face = 0; face < faces; ++face) {
    std::vector<KnownPoint> on_face;
    for (std::size_t i = 0; i < candidate.faces.size(); ++i) {
      if (candidate.faces[i] == face) on_face.push_back(candidate.seen.points[i]);
    }
    if (on_face.size() < kLeastPoints) continue;
    const PointSpread spread = spreadOf(on_face);
    if (spread.onOneLine() || !spread.inOnePlane()) continue;
    std::vector<cv::Point3f>& places = flat.places.emplace_back();
    std::vector<cv::Point2f>& pixels = flat.pixels.emplace_back();
    for (const KnownPoint& point : on_face) {
      const Eigen::Vector3f place =
          (spread.principal_from_target * point.position_in_target).cast<float>();
      const Eigen::Vector2f pixel = point.pixel.cast<float>();
      places.emplace_back(place.x(), place.y(), 0.0F);
      pixels.emplace_back(pixel.x(), pixel.y());
    }
  }
}

CameraModel startCamera(const std::vector<Candidate>& candidates,
                        const Eigen::Vector2i& image_size_px) {
  FlatViews flat;
  for (const Candidate& candidate : candidates) addFlatViews(candidate, flat);
  // A usual lens, for when the homographies say nothing.
  const double usual_px = 1.2 * image_size_px.maxCoeff();
  double focal_px = usual_px;
  if (!flat.places.empty()) {
    const cv::Mat k = cv::initCameraMatrix2D(flat.places, flat.pixels,
                                             {image_size_px.x(), image_size_px.y()}, 1.0);
    focal_px = k.at<double>(1, 1);
  }
  if (!(focal_px > 0.1 * usual_px && focal_px < 20.0 * usual_px)) focal_px = usual_px;
  CameraModel camera;
  camera.width_px = image_size_px.x();
  camera.height_px = image_size_px.y();
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (image_size_px.x() - 1);
  camera.cy = 0.5 * (image_size_px.y() - 1);
  return camera;
}

// Finds where the target was; false when nothing fits.
bool findPose(const CameraModel& camera, CameraView& view) {
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> pixels;
  for (const KnownPoint& point : view.points) {
    const Eigen::Vector3d& x = point.position_in_target;
    places.emplace_back(x.x(), x.y(), x.z());
    pixels.emplace_back(point.pixel.x(), point.pixel.y());
  }
  const cv::Matx33d k(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
  cv::Vec3d turn;
  cv::Vec3d translation;
  if (!cv::solvePnP(places, pixels, k, cv::noArray(), turn, translation, false,
                    cv::SOLVEPNP_SQPNP)) {
    return false;
  }
  const Eigen::Vector3d axis(turn[0], turn[1], turn[2]);
  const double angle_rad = axis.norm();
  view.cam_from_target.rotation.setIdentity();
  if (angle_rad > 0.0) {
    view.cam_from_target.rotation =
        Eigen::AngleAxisd(angle_rad, axis / angle_rad).toRotationMatrix();
  }
  view.cam_from_target.translation = {translation[0], translation[1], translation[2]};
  return std::all_of(view.points.begin(), view.points.end(), [&](const KnownPoint& point) {
    return (view.cam_from_target * point.position_in_target).z() > 0.0;
  });
}

using UsedMask = std::vector<std::vector<char>>;

// The views with the poses of the last fit and only the points still used.
std::vector<CameraView> usedViews(const std::vector<Candidate>& candidates, const UsedMask& used,
                                  const std::vector<Rigid3>& cam_from_target) {
  std::vector<CameraView> views;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    CameraView& view = views.emplace_back();
    view.cam_from_target = cam_from_target[c];
    for (std::size_t i = 0; i < used[c].size(); ++i) {
      if (used[c][i] != 0) view.points.push_back(candidates[c].seen.points[i]);
    }
  }
  return views;
}

Eigen::Vector2d residualOf(const RefinedCamera& fit, std::size_t view, const KnownPoint& point) {
  const Eigen::Vector3d in_cam = fit.cam_from_target[view] * point.position_in_target;
  return point.pixel - fit.camera.pixelFromNormalized(in_cam.hnormalized());
}

// Marks what is within the limit; returns whether a mark changed.
bool markUsed(const std::vector<Candidate>& candidates, const RefinedCamera& fit,
              double outlier_sigma, UsedMask& used) {
  std::vector<double> lengths_px;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    for (const KnownPoint& point : candidates[c].seen.points) {
      lengths_px.push_back(residualOf(fit, c, point).norm());
    }
  }
  std::vector<double> sorted = lengths_px;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit_px = outlier_sigma * std::max(*middle / kMedianOfLength, kLeastSpread_px);
  bool changed = false;
  std::size_t next = 0;
  for (auto& of_view : used) {
    for (char& mark : of_view) {
      const char now = lengths_px[next++] <= limit_px ? 1 : 0;
      changed = changed || now != mark;
      mark = now;
    }
  }
  return changed;
}

// A view of which less than half fits was matched wrongly as a whole, or shows too little.
void dropPoorViews(std::vector<Candidate>& candidates, RefinedCamera& fit, UsedMask& used) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const auto fitting =
        static_cast<std::size_t>(std::count(used[c].begin(), used[c].end(), char{1}));
    if (fitting < kLeastPoints || 2 * fitting < used[c].size()) continue;
    if (kept != c) {
      candidates[kept] = std::move(candidates[c]);
      fit.cam_from_target[kept] = fit.cam_from_target[c];
      used[kept] = std::move(used[c]);
    }
    ++kept;
  }
  candidates.resize(kept);
  fit.cam_from_target.resize(kept);
  used.resize(kept);
}

// Two robust fits, the first of focal length and k1 alone, which no poor start can mislead.
Result<RefinedCamera> fitRobustly(const CameraModel& start, const std::vector<CameraView>& views,
                                  RefineOptions all, const Task& task) {
  RefineOptions few;
  few.free_aspect = few.free_principal = few.free_k2 = false;
  few.cauchy_sigma = kCauchy_sigma;
  auto first = refineCamera(start, views, few, task);
  if (!first) return first;
  std::vector<CameraView> closer = views;
  for (std::size_t v = 0; v < views.size(); ++v) {
    closer[v].cam_from_target = first->cam_from_target[v];
  }
  all.cauchy_sigma = kCauchy_sigma;
  return refineCamera(first->camera, closer, all, task);
}

// Whether a parameter is so far from zero that noise does not explain it.
bool isSure(const RefinedCamera& fit, CameraParameter parameter, double value) {
  return std::abs(value) > kSure_sigma * std::sqrt(fit.covariance(parameter, parameter));
}

HandHeldCalibration resultOf(const std::vector<Candidate>& candidates, const RefinedCamera& fit,
                             const UsedMask& used, std::span<const TargetView> views) {
  HandHeldCalibration result;
  result.calibration.camera = fit.camera;
  result.covariance = fit.covariance;
  result.cam_from_target.resize(views.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const Candidate& candidate = candidates[c];
    result.cam_from_target[static_cast<std::size_t>(candidate.view)] = fit.cam_from_target[c];
    for (std::size_t i = 0; i < candidate.points.size(); ++i) {
      const KnownPoint& point = candidate.seen.points[i];
      result.report.residuals.push_back({candidate.view, candidate.points[i], point.pixel,
                                         residualOf(fit, c, point), used[c][i] != 0});
    }
  }
  result.report.views = candidates.size();
  summarizeResiduals(result.report);
  reportSigmas(fit.covariance, result.report);
  const std::size_t left_out = views.size() - candidates.size();
  if (left_out > 0) {
    result.report.remarks.push_back(
        std::to_string(left_out) + (left_out == 1 ? " picture was" : " pictures were") +
        " left out: too little of the target is seen, or it does not fit.");
  }
  return result;
}

Result<HandHeldCalibration> calibrate(std::vector<Candidate> candidates,
                                      std::span<const TargetView> views, const CameraModel& start,
                                      const HandHeldOptions& options, const Task& task) {
  std::erase_if(candidates, [&](Candidate& candidate) { return !findPose(start, candidate.seen); });
  std::vector<CameraView> all_points;
  UsedMask used;
  for (const Candidate& candidate : candidates) {
    all_points.push_back(candidate.seen);
    used.emplace_back(candidate.points.size(), 1);
  }
  task.report(0.1, "Finding the camera");
  RefineOptions plain = options.refine;
  plain.cauchy_sigma = 0.0;
  auto fit = fitRobustly(start, all_points, plain, task);
  if (!fit) return fit.error();
  if (!plain.free_k3) {
    RefineOptions more = plain;
    more.free_k3 = true;
    auto wider = fitRobustly(start, all_points, more, task);
    if (wider && isSure(*wider, kK3, wider->camera.k3)) {
      fit = std::move(wider);
      plain = more;
    }
  }
  for (int round = 0; round < kOutlierRounds; ++round) {
    const bool changed = markUsed(candidates, *fit, options.outlier_sigma, used);
    if (!changed && round > 0) break;
    dropPoorViews(candidates, *fit, used);
    fit = refineCamera(fit->camera, usedViews(candidates, used, fit->cam_from_target), plain, task);
    if (!fit) return fit.error();
    task.report(0.6 + 0.1 * round, "Finding the camera");
  }
  const double focal_sigma_px = std::sqrt(fit->covariance(kFy, kFy));
  if (!(focal_sigma_px < kMostFocalSigma * fit->camera.fy)) {
    return Error{Error::Code::kTooFew, "These pictures leave the focal length open.",
                 "Take more of them, with the target tilted by 30 degrees and more to all sides."};
  }
  return resultOf(candidates, *fit, used, views);
}

}  // namespace

Result<HandHeldCalibration> calibrateHandHeld(const Target& target,
                                              std::span<const TargetView> views,
                                              const Eigen::Vector2i& image_size_px,
                                              const HandHeldOptions& options, const Task& task) {
  if (!(image_size_px.minCoeff() > 0) || !(options.outlier_sigma >= 3.0)) {
    return Error{Error::Code::kInvalidInput, "The size of the pictures or an option is not usable.",
                 "Give the width and height in pixels, and at least 3 for the outliers' limit."};
  }
  auto candidates = candidatesOf(target, views);
  if (!candidates) return candidates.error();
  try {
    const CameraModel start = startCamera(*candidates, image_size_px);
    return calibrate(std::move(*candidates), views, start, options, task);
  } catch (const std::exception& problem) {
    return Error{Error::Code::kInternal,
                 std::string("The calibration failed: ") + problem.what() + ".", ""};
  }
}

}  // namespace gyre
