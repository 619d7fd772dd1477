// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_precision.h"

#include <algorithm>
#include <cstddef>

namespace gyre {
namespace {

constexpr std::size_t kNeighbours = 8;
constexpr double kLeastWeight = 1e-6;  // of a triangle's corner that has a say in a place

std::vector<Eigen::Vector3d> positionsOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return positions;
}

std::vector<Eigen::Vector3d> seenPositionsOf(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> positions;
  for (const MeshVertex& vertex : mesh.vertices) {
    if (vertex.seen != 0) positions.push_back(vertex.position);
  }
  return positions;
}

bool seenAt(const Mesh& mesh, const SurfaceHit& hit) {
  if (mesh.triangles.empty()) return mesh.vertices[hit.piece].seen != 0;
  for (int k = 0; k < 3; ++k) {
    const auto corner = mesh.triangles[hit.piece][static_cast<std::size_t>(k)];
    if (hit.weights[k] > kLeastWeight && mesh.vertices[corner].seen == 0) return false;
  }
  return true;
}

}  // namespace

PointPrecision::PointPrecision(const PointCloud& cloud) : tree_(positionsOf(cloud)) {
  covariances_.reserve(cloud.points.size());
  for (const Point& point : cloud.points) covariances_.push_back(point.covariance);
}

PointPrecision::PointPrecision(const Mesh& mesh) : tree_(seenPositionsOf(mesh)) {
  covariances_.reserve(tree_.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    const double sigma_mm = vertex.sigma_mm;
    if (vertex.seen != 0) covariances_.push_back(sigma_mm * sigma_mm * Eigen::Matrix3d::Identity());
  }
}

std::optional<Eigen::Matrix3d> PointPrecision::covarianceAt(
    const Eigen::Vector3d& place_in_table) const {
  auto near = tree_.nearest(place_in_table, kNeighbours);
  if (near.empty()) return std::nullopt;
  // Within the circle around the nearest point that holds eight of them, the place lies among
  // points; farther off, between points and nothing.
  const Eigen::Vector3d first = tree_.point(near.front().index);
  const double reach_mm2 = tree_.nearest(first, kNeighbours).back().squared_mm2;
  if (near.size() > 1 && near.front().squared_mm2 > reach_mm2) return std::nullopt;
  const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
  const auto less = [&](const KdTree::Neighbour& a, const KdTree::Neighbour& b) {
    return covariances_[a.index].trace() < covariances_[b.index].trace();
  };
  std::nth_element(near.begin(), middle, near.end(), less);
  const Eigen::Matrix3d& covariance = covariances_[middle->index];
  if (!covariance.allFinite() || !(covariance.trace() > 0.0)) return std::nullopt;
  return covariance;
}

PickedPoint pickNearest(const Mesh& mesh, const SurfaceIndex& surface,
                        const PointPrecision& precision, const Eigen::Vector3d& place_in_table) {
  const SurfaceHit hit = surface.nearest(place_in_table);
  PickedPoint picked;
  picked.position = hit.position;
  picked.seen = seenAt(mesh, hit);
  if (picked.seen) picked.covariance = precision.covarianceAt(hit.position);
  return picked;
}

}  // namespace gyre
