// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/target.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include <Eigen/Geometry>

#include "core/base/check.h"

namespace gyre {
namespace {

// A marker is printed on its face: what lies further off its plane belongs to another one.
constexpr double kInPlane_mm = 0.05;

struct Plane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

// The plane through the three of the points that span the widest triangle with the first of them.
std::optional<Plane> planeThrough(const std::vector<Eigen::Vector3d>& points) {
  Plane plane;
  double widest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Eigen::Vector3d normal = (points[i] - points[0]).cross(points[j] - points[0]);
      if (normal.norm() <= widest) continue;
      widest = normal.norm();
      plane = {points[0], normal.normalized()};
    }
  }
  if (widest <= 0.0) return std::nullopt;
  return plane;
}

bool holds(const Plane& plane, const TargetMarker& marker) {
  return std::all_of(marker.corners_in_target.begin(), marker.corners_in_target.end(),
                     [&](const Eigen::Vector3d& corner) {
                       return std::abs(plane.normal.dot(corner - plane.origin)) <= kInPlane_mm;
                     });
}

}  // namespace

std::vector<TargetPoint> pointsOf(const Target& target) {
  std::unordered_map<int, std::size_t> index_of;
  std::vector<TargetPoint> points;
  for (const TargetCorner& corner : target.corners) {
    index_of.emplace(corner.id, points.size());
    points.push_back({corner.position_in_target, -1, corner.id, -1});
  }
  std::vector<std::optional<Plane>> planes;
  for (std::size_t face = 0; face < target.faces.size(); ++face) {
    std::vector<Eigen::Vector3d> members;
    for (const int id : target.faces[face]) {
      const auto found = index_of.find(id);
      if (found == index_of.end()) continue;
      points[found->second].face = static_cast<int>(face);
      members.push_back(points[found->second].position_in_target);
    }
    planes.push_back(planeThrough(members));
  }
  for (const TargetMarker& marker : target.markers) {
    int face = -1;
    for (std::size_t i = 0; i < planes.size() && face < 0; ++i) {
      if (planes[i] && holds(*planes[i], marker)) face = static_cast<int>(i);
    }
    for (const Eigen::Vector3d& corner : marker.corners_in_target) {
      points.push_back({corner, face, -1, marker.id});
    }
  }
  return points;
}

Target withPoints(Target target, const std::vector<Eigen::Vector3d>& positions_in_target) {
  GYRE_CHECK(positions_in_target.size() == target.corners.size() + 4 * target.markers.size());
  auto next = positions_in_target.begin();
  for (TargetCorner& corner : target.corners) corner.position_in_target = *next++;
  for (TargetMarker& marker : target.markers) {
    for (Eigen::Vector3d& corner : marker.corners_in_target) corner = *next++;
  }
  return target;
}

}  // namespace gyre
