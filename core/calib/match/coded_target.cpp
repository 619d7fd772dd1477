// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/coded_target.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/calib/match/marker_corners.h"
#include "core/scan/marker_dictionary.h"

namespace gyre {
namespace {

// The first point of each marker by its id.
std::map<int, std::size_t> firstPoints(const std::vector<TargetPoint>& points) {
  std::map<int, std::size_t> first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].marker_id >= 0) first.emplace(points[i].marker_id, i);
  }
  return first;
}

// Ids that were read more than once name no single place.
std::set<int> repeated(const MarkerDetection& detection) {
  std::set<int> twice;
  for (std::size_t i = 1; i < detection.markers.size(); ++i) {
    if (detection.markers[i].id == detection.markers[i - 1].id) {
      twice.insert(detection.markers[i].id);
    }
  }
  return twice;
}

}  // namespace

std::vector<PointSighting> CodedSearch::allSightings() const {
  std::vector<PointSighting> all = marker_sightings;
  for (const FaceSearch& face : faces) {
    all.insert(all.end(), face.sightings.begin(), face.sightings.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.point < b.point; });
  return all;
}

Result<CodedSearch> searchCodedTarget(const TargetPicture& picture, const Target& target,
                                      std::span<const TargetFace> faces) {
  auto detection = detectMarkers(picture.grey, target.dictionary);
  if (!detection) return detection.error();
  const int modules_a_side = markerDictionary(target.dictionary)->modulesASide();
  const std::vector<TargetPoint> points = pointsOf(target);
  const auto first_point = firstPoints(points);
  CodedSearch search;
  search.detection = std::move(*detection);
  const std::set<int> twice = repeated(search.detection);
  for (const DetectedMarker& marker : search.detection.markers) {
    const auto first = first_point.find(marker.id);
    ++(first == first_point.end() ? search.stranger_markers : search.own_markers);
    if (first == first_point.end() || twice.contains(marker.id)) continue;
    const int face = points[first->second].face;
    if (face >= 0 && !faces[static_cast<std::size_t>(face)].corners.empty()) continue;
    const auto refined = refineMarker(picture.grey, marker.corners, modules_a_side);
    if (!refined) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      search.marker_sightings.push_back(
          {static_cast<int>(first->second + k), refined->corners[k], refined->sigma_px[k]});
    }
  }
  for (const TargetFace& face : faces) {
    if (face.corners.empty() || face.markers.empty()) continue;
    auto found = searchCodedFace(picture, face, search.detection.markers, modules_a_side);
    if (found) search.faces.push_back(std::move(*found));
  }
  return search;
}

}  // namespace gyre
