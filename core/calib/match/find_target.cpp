// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/find_target.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/calib/match/coded_target.h"
#include "core/calib/match/target_hindrance.h"
#include "core/calib/match/target_picture.h"
#include "core/calib/match/uncoded_target.h"

namespace gyre {
namespace {

std::vector<FaceFinding> findingsOf(const std::vector<TargetPoint>& points,
                                    std::span<const TargetFace> faces,
                                    const std::vector<PointSighting>& sightings) {
  std::map<int, int> seen;
  for (const PointSighting& sighting : sightings) {
    ++seen[points[static_cast<std::size_t>(sighting.point)].face];
  }
  std::vector<FaceFinding> findings;
  for (const auto& entry : seen) {
    const int face = entry.first;
    int expected = 0;
    if (face >= 0 && !faces[static_cast<std::size_t>(face)].corners.empty()) {
      expected = static_cast<int>(faces[static_cast<std::size_t>(face)].corners.size());
    } else {
      expected = static_cast<int>(std::count_if(points.begin(), points.end(), [&](const auto& p) {
        return p.face == face && p.marker_id >= 0;
      }));
    }
    findings.push_back({face, entry.second, expected});
  }
  return findings;
}

Error noWayToFind(const Target& target) {
  return {Error::Code::kInvalidInput,
          "The target '" + target.name +
              "' carries no codes, and the corners of its faces are not rows and columns.",
          "Describe its faces in the target file, each with corners in rows and columns."};
}

}  // namespace

Result<void> FindTargetOptions::validate() const {
  if (min_points >= 4 && min_points <= 10000) return {};
  return Error{Error::Code::kInvalidInput, "The least number of points is out of its range.",
               "Ask for 4 to 10000 points."};
}

Result<FoundTarget> findTarget(const cv::Mat& image, const Target& target,
                               const FindTargetOptions& options, const Task& task) {
  if (auto valid = options.validate(); !valid) return valid.error();
  auto picture = targetPicture(image);
  if (!picture) return picture.error();
  const std::vector<TargetFace> faces = facesOf(target);
  FoundTarget found;
  if (!target.markers.empty()) {
    const auto search = searchCodedTarget(*picture, target, faces);
    if (!search) return search.error();
    found.view.sightings = search->allSightings();
    if (static_cast<int>(found.view.sightings.size()) < options.min_points) {
      return whyCodedNotFound(*picture, target, *search, options.min_points);
    }
  } else {
    const bool any_grid = std::any_of(faces.begin(), faces.end(),
                                      [](const auto& face) { return face.grid.has_value(); });
    if (!any_grid) return noWayToFind(target);
    const auto search = searchUncodedTarget(*picture, target, faces, options, task);
    if (task.stopRequested()) return cancelled();
    found.view.sightings = search.allSightings();
    if (static_cast<int>(found.view.sightings.size()) < options.min_points) {
      return whyUncodedNotFound(*picture, faces, search, options.min_points);
    }
    found.other_cam_from_target = search.assignment->others;
    found.labellings = 1 + static_cast<int>(found.other_cam_from_target.size());
    found.cam_from_target = search.assignment->pose.cam_from_target;
    found.camera = search.assignment->pose.camera;
  }
  found.faces = findingsOf(pointsOf(target), faces, found.view.sightings);
  return found;
}

}  // namespace gyre
