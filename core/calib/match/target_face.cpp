// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace gyre {
namespace {

constexpr double kOffLattice = 0.08;  // as a share of the pitch
constexpr double kOnFace_mm = 0.1;    // what a description may round off

struct Members {
  std::vector<int> points;
  std::vector<Eigen::Vector3d> positions;
};

struct Plane {
  Eigen::Vector3d middle;
  Eigen::Vector3d normal;
};

std::optional<Plane> planeOf(const std::vector<Eigen::Vector3d>& positions) {
  if (positions.size() < 3) return std::nullopt;
  Plane plane;
  plane.middle.setZero();
  for (const auto& p : positions) plane.middle += p / static_cast<double>(positions.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : positions) {
    scatter += (p - plane.middle) * (p - plane.middle).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  if (!(solver.eigenvalues()[1] > 1e-6 * solver.eigenvalues()[2])) return std::nullopt;
  plane.normal = solver.eigenvectors().col(0);
  return plane;
}

// The shortest way between two corners: along a lattice's rows or columns.
Eigen::Vector3d shortestStep(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d shortest = Eigen::Vector3d::UnitX();
  double length = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const Eigen::Vector3d step = positions[j] - positions[i];
      if (step.norm() >= length * (1.0 - 1e-6)) continue;
      length = step.norm();
      shortest = step;
    }
  }
  return shortest;
}

// The least difference between two coordinates that is not just inaccuracy.
double pitchOf(const std::vector<TargetFace::Corner>& corners, int axis, double least_mm) {
  std::vector<double> sorted;
  sorted.reserve(corners.size());
  for (const auto& corner : corners) sorted.push_back(corner.place_mm[axis]);
  std::sort(sorted.begin(), sorted.end());
  double pitch_mm = std::numeric_limits<double>::max();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double step_mm = sorted[i] - sorted[i - 1];
    if (step_mm > least_mm) pitch_mm = std::min(pitch_mm, step_mm);
  }
  return pitch_mm;
}

std::optional<FaceGrid> gridOf(const std::vector<TargetFace::Corner>& corners, double step_mm) {
  FaceGrid grid;
  Eigen::Vector2d least = corners.front().place_mm;
  Eigen::Vector2d most = least;
  for (const auto& corner : corners) {
    least = least.cwiseMin(corner.place_mm);
    most = most.cwiseMax(corner.place_mm);
  }
  for (int axis = 0; axis < 2; ++axis) {
    grid.pitch_mm[axis] = pitchOf(corners, axis, 0.3 * step_mm);
  }
  const Eigen::Array2d cells = (most - least).array() / grid.pitch_mm.array();
  if (!(cells.maxCoeff() < 1000.0) || cells.minCoeff() < 0.5) return std::nullopt;
  grid.columns = static_cast<int>(std::lround(cells.x())) + 1;
  grid.rows = static_cast<int>(std::lround(cells.y())) + 1;
  grid.corner_of_cell.assign(static_cast<std::size_t>(grid.columns * grid.rows), -1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Array2d cell = (corners[i].place_mm - least).array() / grid.pitch_mm.array();
    const Eigen::Array2d whole = cell.round();
    if ((cell - whole).abs().maxCoeff() > kOffLattice) return std::nullopt;
    int& owner = grid.corner_of_cell[static_cast<std::size_t>(
        static_cast<int>(whole.y()) * grid.columns + static_cast<int>(whole.x()))];
    if (owner >= 0) return std::nullopt;
    owner = static_cast<int>(i);
  }
  return grid;
}

// Which way the faces look that neither a page nor a marker tells: see facesOf().
void turnOutward(const std::vector<std::optional<Plane>>& planes,
                 std::vector<std::optional<Eigen::Vector3d>>& outward) {
  std::size_t flattest = planes.size();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!planes[i]) continue;
    if (flattest == planes.size() ||
        std::abs(planes[i]->normal.z()) > std::abs(planes[flattest]->normal.z()) + 1e-9) {
      flattest = i;
    }
  }
  if (flattest == planes.size()) return;
  const auto lie_above = [&](std::size_t face, const Eigen::Vector3d& normal) {
    double sum = 0.0;
    for (const auto& other : planes) {
      if (other) sum += normal.dot(other->middle - planes[face]->middle);
    }
    return sum > 0.0;
  };
  const Eigen::Vector3d up = planes[flattest]->normal.z() < 0.0
                                 ? Eigen::Vector3d(-planes[flattest]->normal)
                                 : planes[flattest]->normal;
  const bool hollow = lie_above(flattest, up);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!planes[i] || outward[i]) continue;
    if (i == flattest) {
      outward[i] = up;
    } else {
      const bool as_is = lie_above(i, planes[i]->normal) == hollow;
      outward[i] = as_is ? planes[i]->normal : Eigen::Vector3d(-planes[i]->normal);
    }
  }
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

void measureClearance(TargetFace& face) {
  for (auto& corner : face.corners) {
    // The square's next edges are as far away as the next corner of either direction.
    double clear_mm = std::numeric_limits<double>::max();
    for (const auto& other : face.corners) {
      if (other.point != corner.point) {
        clear_mm = std::min(clear_mm, (other.place_mm - corner.place_mm).norm());
      }
    }
    for (const auto& marker : face.markers) {
      for (std::size_t k = 0; k < 4; ++k) {
        clear_mm = std::min(clear_mm, distanceToSegment(corner.place_mm, marker.corners_mm[k],
                                                        marker.corners_mm[(k + 1) % 4]));
      }
    }
    corner.clear_mm = clear_mm;
  }
}

// Which way each face looks by its page axes or its markers.
std::vector<std::optional<Eigen::Vector3d>> outwardAsPrinted(
    const Target& target, const std::vector<TargetPoint>& points) {
  std::vector<std::optional<Eigen::Vector3d>> outward(target.faces.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].marker_id < 0) continue;
    if (points[i].face >= 0) {
      // Clockwise from outside: from the first side to the second one turns about the way in.
      const auto corner = [&](std::size_t k) { return points[i + k].position_in_target; };
      outward[static_cast<std::size_t>(points[i].face)] =
          -(corner(1) - corner(0)).cross(corner(2) - corner(1)).normalized();
    }
    i += 3;
  }
  for (std::size_t i = 0; i < std::min(outward.size(), target.page_axes.size()); ++i) {
    const PageAxes& axes = target.page_axes[i];
    const Eigen::Vector3d out = axes.down_in_target.cross(axes.right_in_target);
    if (out.norm() > 0.5) outward[i] = out.normalized();
  }
  return outward;
}

// Of the four directions of the face's lattice, right is the one that was right on the page.
void layAxes(const Eigen::Vector3d& outward, const PageAxes* page, const Members& members,
             TargetFace& face) {
  const Eigen::Vector3d step = shortestStep(members.positions);
  face.origin_in_target = members.positions.front();
  face.right_in_target = (step - step.dot(outward) * outward).normalized();
  if (page != nullptr && page->right_in_target.norm() > 0.5) {
    const Eigen::Vector3d across = face.right_in_target.cross(outward);
    if (std::abs(across.dot(page->right_in_target)) >
        std::abs(face.right_in_target.dot(page->right_in_target))) {
      face.right_in_target = across;
    }
    if (face.right_in_target.dot(page->right_in_target) < 0.0) face.right_in_target *= -1.0;
  }
  face.down_in_target = face.right_in_target.cross(outward);
}

void addMarkers(const std::vector<TargetPoint>& points, TargetFace& face) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].marker_id < 0) continue;
    if (points[k].face == face.index) {
      TargetFace::Marker marker{points[k].marker_id, static_cast<int>(k), {}};
      for (std::size_t c = 0; c < 4; ++c) {
        marker.corners_mm[c] = face.placeOf(points[k + c].position_in_target);
      }
      face.markers.push_back(marker);
    }
    k += 3;
  }
}

}  // namespace

int FaceGrid::cornerAt(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns || row >= rows) return -1;
  return corner_of_cell[static_cast<std::size_t>(row * columns + column)];
}

Eigen::Vector3d TargetFace::outwardInTarget() const {
  return down_in_target.cross(right_in_target);
}

Eigen::Vector2d TargetFace::placeOf(const Eigen::Vector3d& point_in_target) const {
  const Eigen::Vector3d from_origin = point_in_target - origin_in_target;
  return {right_in_target.dot(from_origin), down_in_target.dot(from_origin)};
}

bool TargetFace::holds(const Eigen::Vector3d& point_in_target) const {
  return std::abs(outwardInTarget().dot(point_in_target - origin_in_target)) < kOnFace_mm;
}

Eigen::Vector3d TargetFace::pointAt(const Eigen::Vector2d& place_mm) const {
  return origin_in_target + place_mm.x() * right_in_target + place_mm.y() * down_in_target;
}

std::vector<TargetFace> facesOf(const Target& target) {
  const std::vector<TargetPoint> points = pointsOf(target);
  const std::size_t count = target.faces.size();
  std::vector<Members> members(count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].face < 0 || points[i].corner_id < 0) continue;
    Members& face = members[static_cast<std::size_t>(points[i].face)];
    face.points.push_back(static_cast<int>(i));
    face.positions.push_back(points[i].position_in_target);
  }
  std::vector<std::optional<Plane>> planes(count);
  for (std::size_t i = 0; i < count; ++i) planes[i] = planeOf(members[i].positions);
  auto outward = outwardAsPrinted(target, points);
  turnOutward(planes, outward);

  std::vector<TargetFace> faces(count);
  for (std::size_t i = 0; i < count; ++i) {
    TargetFace& face = faces[i];
    face.index = static_cast<int>(i);
    if (!planes[i] || !outward[i]) continue;
    const Eigen::Vector3d out =
        planes[i]->normal.dot(*outward[i]) > 0.0 ? planes[i]->normal : -planes[i]->normal;
    layAxes(out, i < target.page_axes.size() ? &target.page_axes[i] : nullptr, members[i], face);
    for (std::size_t k = 0; k < members[i].points.size(); ++k) {
      face.corners.push_back({members[i].points[k], face.placeOf(members[i].positions[k]), 0.0});
    }
    face.grid = gridOf(face.corners, shortestStep(members[i].positions).norm());
    addMarkers(points, face);
    measureClearance(face);
  }
  return faces;
}

}  // namespace gyre
