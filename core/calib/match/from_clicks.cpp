// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/from_clicks.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/calib/corners/corner_index.h"
#include "core/calib/lens/rough_pose.h"
#include "core/calib/match/labelling_evidence.h"
#include "core/calib/match/target_face.h"
#include "core/calib/match/target_picture.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastClicks = 6;
constexpr std::size_t kLeastFound = 8;
constexpr std::size_t kEnoughForDistortion = 20;
constexpr double kMostOffSquare = 0.35;  // of the distance to the next corner in the picture
// Clicks that miss the target's shape by more than this share of its size are on wrong corners.
constexpr double kMostMisfit = 0.04;

struct Snap {
  int point = 0;
  KnownPoint known;
};

Error wrongClicks(const std::string& what) {
  return {Error::Code::kInvalidInput, what,
          "Click six corners on three faces, at least two on each, each on the one that is asked "
          "for."};
}

// The clicked corners, moved to a detected corner near them: a hand is good to a few pixels.
Result<std::vector<Snap>> clickedPoints(const std::vector<TargetPoint>& points,
                                        std::span<const CornerClick> clicks,
                                        std::span<const XCorner> corners, double snap_px) {
  if (clicks.size() < kLeastClicks) return wrongClicks("Fewer than six corners were clicked.");
  const CornerIndex index(corners);
  std::map<int, int> point_of_id;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].corner_id >= 0) point_of_id.emplace(points[i].corner_id, static_cast<int>(i));
  }
  std::set<int> seen;
  std::vector<Snap> snaps;
  for (const CornerClick& click : clicks) {
    const auto point = point_of_id.find(click.corner_id);
    if (point == point_of_id.end() || !click.pixel.allFinite()) {
      return wrongClicks("A click is on no corner of the target.");
    }
    if (!seen.insert(click.corner_id).second) {
      return wrongClicks("One corner was clicked twice.");
    }
    const int near = index.nearestWithin(click.pixel, snap_px);
    const Eigen::Vector2d pixel =
        near >= 0 ? corners[static_cast<std::size_t>(near)].pixel : click.pixel;
    const auto& position = points[static_cast<std::size_t>(point->second)].position_in_target;
    snaps.push_back({point->second, {position, pixel, 1.0}});
  }
  return snaps;
}

std::vector<KnownPoint> knownPoints(const std::vector<Snap>& snaps) {
  std::vector<KnownPoint> known;
  known.reserve(snaps.size());
  for (const Snap& snap : snaps) known.push_back(snap.known);
  return known;
}

// All corners of faces that look at the camera, where a detected one is near enough.
std::vector<Snap> snapAll(const RoughPose& pose, std::span<const TargetFace> faces,
                          std::span<const XCorner> corners, double snap_px) {
  const CornerIndex index(corners);
  std::vector<Snap> snaps;
  std::set<int> taken;
  for (const TargetFace& face : faces) {
    if (!looksAtCamera(face, pose.cam_from_target, 0.05)) continue;
    std::vector<std::optional<Eigen::Vector2d>> pixels;
    for (const auto& corner : face.corners) {
      pixels.push_back(pose.camera.project(pose.cam_from_target * face.pointAt(corner.place_mm)));
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!pixels[i]) continue;
      double reach_px = snap_px;
      for (std::size_t j = 0; j < pixels.size(); ++j) {
        if (j == i || !pixels[j]) continue;
        reach_px = std::min(reach_px, kMostOffSquare * (*pixels[j] - *pixels[i]).norm());
      }
      const int near = index.nearestWithin(*pixels[i], reach_px);
      if (near < 0 || !taken.insert(near).second) continue;
      const XCorner& corner = corners[static_cast<std::size_t>(near)];
      snaps.push_back({face.corners[i].point,
                       {face.pointAt(face.corners[i].place_mm), corner.pixel, corner.sigma_px}});
    }
  }
  return snaps;
}

void dropOutliers(const RoughPose& pose, std::vector<Snap>& snaps) {
  constexpr double kLeast_px = 0.5;
  std::vector<double> misses;
  for (const Snap& snap : snaps) {
    const auto pixel = pose.camera.project(pose.cam_from_target * snap.known.position_in_target);
    misses.push_back(pixel ? (*pixel - snap.known.pixel).norm() : 1e9);
  }
  std::vector<double> sorted = misses;
  std::sort(sorted.begin(), sorted.end());
  const double most =
      sorted.empty() ? 0.0 : std::max(kLeast_px, 3.0 * 1.4826 * sorted[sorted.size() / 2]);
  std::vector<Snap> kept;
  for (std::size_t i = 0; i < snaps.size(); ++i) {
    if (misses[i] <= most) kept.push_back(snaps[i]);
  }
  snaps = std::move(kept);
}

FoundTarget foundFrom(std::vector<Snap> snaps, const std::vector<TargetPoint>& points,
                      const RoughPose& pose, std::span<const TargetFace> faces) {
  std::sort(snaps.begin(), snaps.end(),
            [](const Snap& a, const Snap& b) { return a.point < b.point; });
  FoundTarget found;
  std::map<int, int> seen;
  for (const Snap& snap : snaps) {
    found.view.sightings.push_back({snap.point, snap.known.pixel, snap.known.sigma_px});
    ++seen[points[static_cast<std::size_t>(snap.point)].face];
  }
  for (const auto& [face, count] : seen) {
    const auto& corners = faces[static_cast<std::size_t>(face)].corners;
    found.faces.push_back({face, count, static_cast<int>(corners.size())});
  }
  found.cam_from_target = pose.cam_from_target;
  found.camera = pose.camera;
  return found;
}

}  // namespace

Result<void> ClickOptions::validate() const {
  if (snap_px >= 1.0 && snap_px <= 50.0) return {};
  return Error{Error::Code::kInvalidInput, "The distance for snapping is out of its range.",
               "Use 1 to 50 pixels."};
}

Result<FoundTarget> targetFromClicks(const cv::Mat& image, const Target& target,
                                     std::span<const CornerClick> clicks,
                                     const ClickOptions& options) {
  if (auto valid = options.validate(); !valid) return valid.error();
  const auto picture = targetPicture(image);
  if (!picture) return picture.error();
  const std::vector<TargetPoint> points = pointsOf(target);
  const std::vector<TargetFace> faces = facesOf(target);
  const std::vector<XCorner> corners = detectXCorners(picture->grey);
  auto clicked = clickedPoints(points, clicks, corners, options.snap_px);
  if (!clicked) return clicked.error();
  std::set<int> clicked_faces;
  for (const Snap& snap : *clicked) {
    clicked_faces.insert(points[static_cast<std::size_t>(snap.point)].face);
  }
  if (clicked_faces.size() < 2 && !options.camera) {
    return wrongClicks("All clicks are on one face, which leaves the lens unknown.");
  }

  const CameraModel start =
      options.camera.value_or(unknownCamera(picture->grey.cols, picture->grey.rows));
  const PoseFreedom freedom = options.camera ? PoseFreedom::kPose : PoseFreedom::kFocal;
  auto pose = findRoughPose(knownPoints(*clicked), start, freedom);
  Eigen::Vector2d least = clicked->front().known.pixel;
  Eigen::Vector2d most = least;
  for (const Snap& snap : *clicked) {
    least = least.cwiseMin(snap.known.pixel);
    most = most.cwiseMax(snap.known.pixel);
  }
  if (!pose || pose->rms_px > kMostMisfit * (most - least).norm()) {
    return wrongClicks("The clicks do not fit the target's shape.");
  }
  std::vector<Snap> snaps;
  for (int round = 0; round < 3; ++round) {
    snaps = snapAll(*pose, faces, corners, options.snap_px);
    for (int pass = 0; pass < 2 && snaps.size() >= kLeastFound; ++pass) {
      const bool bend = !options.camera && snaps.size() >= kEnoughForDistortion;
      const auto better =
          refineRoughPose(knownPoints(snaps), *pose, bend ? PoseFreedom::kFocalAndK1 : freedom);
      if (!better) break;
      pose = better;
      dropOutliers(*pose, snaps);
    }
  }
  if (snaps.size() < kLeastFound) {
    return Error{Error::Code::kTooFew,
                 "Hardly any corner of the target is where the clicks say it should be.",
                 "Click again, nearer to the corners, and see that the picture is sharp."};
  }
  return foundFrom(std::move(snaps), points, *pose, faces);
}

}  // namespace gyre
