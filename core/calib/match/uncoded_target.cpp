// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/uncoded_target.h"

#include <algorithm>
#include <set>

namespace gyre {
namespace {

std::vector<FaceSearch> facesOf(const TargetPicture& picture, std::span<const TargetFace> faces,
                                const UncodedSearch& search) {
  std::vector<FaceSearch> found;
  for (const TargetFace& face : faces) {
    FaceSearch seen;
    seen.face = face.index;
    std::set<int> taken;
    for (const LatticeOnFace& laid : search.assignment->laid) {
      if (laid.face != face.index) continue;
      for (const auto& node : search.lattices[static_cast<std::size_t>(laid.lattice)].nodes) {
        const Eigen::Vector2i cell = cellOnFace(laid, node.cell);
        const int corner = face.grid->cornerAt(cell.x(), cell.y());
        if (corner < 0 || !taken.insert(corner).second) continue;
        const XCorner& at = search.corners[static_cast<std::size_t>(node.corner)];
        seen.sightings.push_back(
            {face.corners[static_cast<std::size_t>(corner)].point, at.pixel, at.sigma_px});
      }
    }
    if (seen.sightings.size() < 4) continue;
    dropStrays(face, seen);
    completeFace(picture, face, seen);
    dropStrays(face, seen);
    found.push_back(std::move(seen));
  }
  return found;
}

}  // namespace

std::vector<PointSighting> UncodedSearch::allSightings() const {
  std::vector<PointSighting> all;
  for (const FaceSearch& face : faces) {
    all.insert(all.end(), face.sightings.begin(), face.sightings.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.point < b.point; });
  return all;
}

UncodedSearch searchUncodedTarget(const TargetPicture& picture, const Target& target,
                                  std::span<const TargetFace> faces,
                                  const FindTargetOptions& options, const Task& task) {
  UncodedSearch search;
  search.corners = detectXCorners(picture.grey);
  if (task.stopRequested()) return search;
  search.lattices = growLattices(search.corners);
  if (task.stopRequested()) return search;
  search.assignment = assignLattices({picture, target, faces, search.corners, search.lattices,
                                      options.camera, options.expected_cam_from_target},
                                     task);
  if (search.assignment) search.faces = facesOf(picture, faces, search);
  return search;
}

}  // namespace gyre
