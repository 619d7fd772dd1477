// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/target_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/scan/marker_dictionary.h"

namespace gyre {
namespace {

using Eigen::Vector3d;
using Fault = std::optional<std::string>;

constexpr double kFlat_mm = 0.5;
constexpr double kBelowBase_mm = 0.5;
constexpr double kLeastMarkerSide_mm = 0.1;
constexpr double kSquareness = 0.02;  // of a side
constexpr double kAxisError = 0.02;   // of a unit vector

Fault faultOfMarkers(const Target& target) {
  if (target.markers.empty() && target.dictionary.empty()) return std::nullopt;
  const auto dictionary = markerDictionary(target.dictionary);
  if (!dictionary) {
    return "has markers of the dictionary \"" + target.dictionary + "\", which Gyre does not know";
  }
  std::set<int> ids;
  for (const TargetMarker& marker : target.markers) {
    const std::string name = "marker " + std::to_string(marker.id);
    if (marker.id < 0 || marker.id >= dictionary->markers) {
      return "has the " + name + ", which " + target.dictionary + " does not hold";
    }
    if (!ids.insert(marker.id).second) return "has the " + name + " twice";
    const auto& at = marker.corners_in_target;
    const double side_mm = (at[1] - at[0]).norm();
    // A square: its second side stands at a right angle on the first, and its last corner closes.
    const Vector3d down = at[3] - at[0];
    const bool square = side_mm >= kLeastMarkerSide_mm &&
                        std::abs(down.norm() - side_mm) <= kSquareness * side_mm &&
                        std::abs(down.dot(at[1] - at[0])) <= kSquareness * side_mm * side_mm &&
                        (at[1] + down - at[2]).norm() <= kSquareness * side_mm;
    if (!square) return "has the " + name + ", whose corners make no square";
  }
  return std::nullopt;
}

// How far the points lie off the plane that fits them best, at worst. [mm]
double worstOffPlane(const std::vector<Vector3d>& points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : points) middle += point / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& point : points) scatter += (point - middle) * (point - middle).transpose();
  const Vector3d normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  double worst = 0.0;
  for (const Vector3d& point : points)
    worst = std::max(worst, std::abs(normal.dot(point - middle)));
  return worst;
}

Fault faultOfCornersAndFaces(const Target& target) {
  std::map<int, Vector3d> places;
  for (const TargetCorner& corner : target.corners) {
    if (!places.emplace(corner.id, corner.position_in_target).second) {
      return "has the corner " + std::to_string(corner.id) + " twice";
    }
  }
  std::set<int> on_faces;
  for (std::size_t i = 0; i < target.faces.size(); ++i) {
    const std::string face = "face " + std::to_string(i + 1);
    if (target.faces[i].size() < 3) return "has less than three corners on " + face;
    std::vector<Vector3d> points;
    for (const int id : target.faces[i]) {
      const auto found = places.find(id);
      if (found == places.end()) {
        return "names the corner " + std::to_string(id) + " on " + face + " but does not list it";
      }
      if (!on_faces.insert(id).second) {
        return "puts the corner " + std::to_string(id) + " on its faces more than once";
      }
      points.push_back(found->second);
    }
    if (worstOffPlane(points) > kFlat_mm)
      return "has corners on " + face + " that are not in a plane";
  }
  return std::nullopt;
}

Fault faultOfAxes(const Target& target) {
  if (target.page_axes.empty()) return std::nullopt;
  if (target.page_axes.size() != target.faces.size()) {
    return "does not have an entry in \"page_axes\" for each of its faces";
  }
  for (const PageAxes& axes : target.page_axes) {
    if (std::abs(axes.right_in_target.norm() - 1.0) > kAxisError ||
        std::abs(axes.down_in_target.norm() - 1.0) > kAxisError ||
        std::abs(axes.right_in_target.dot(axes.down_in_target)) > kAxisError) {
      return "has \"page_axes\" that are not two unit vectors at a right angle";
    }
  }
  return std::nullopt;
}

// It stands on z = 0: nothing is below, and it does not hang higher above than it is large.
Fault faultOfBase(const std::vector<TargetPoint>& points) {
  Vector3d low = points.front().position_in_target;
  Vector3d high = low;
  for (const TargetPoint& point : points) {
    low = low.cwiseMin(point.position_in_target);
    high = high.cwiseMax(point.position_in_target);
  }
  if (low.z() >= -kBelowBase_mm && low.z() <= (high - low).norm()) return std::nullopt;
  return "does not stand on z = 0: its lowest point is at z = " +
         std::to_string(std::lround(low.z())) + " mm";
}

}  // namespace

std::optional<std::string> faultOf(const Target& target) {
  const std::vector<TargetPoint> points = pointsOf(target);
  if (points.empty()) return "has neither corners nor markers";
  if (auto fault = faultOfMarkers(target)) return fault;
  if (auto fault = faultOfCornersAndFaces(target)) return fault;
  if (auto fault = faultOfAxes(target)) return fault;
  return faultOfBase(points);
}

}  // namespace gyre
