// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/hull_entry.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr int kBuckets = 64;  // along each side of the grid
constexpr double kLeastForward =
    0.1;  // cosine from the axis, below which a corner is too far aside
constexpr double kOnEdge = -1e-9;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Axes with z along the direction.
Eigen::Matrix3d looking(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = direction.normalized();
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  return rows;
}

}  // namespace

HullEntry::HullEntry(const Tetrahedra& tetrahedra, const Eigen::Vector3d& camera) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : tetrahedra.points) middle += point;
  middle /= static_cast<double>(tetrahedra.points.size());
  picture_from_table_ = looking(middle - camera);

  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e300);
  low_ = -high;
  for (std::uint32_t cell = 0; cell < tetrahedra.cells(); ++cell) {
    if (!tetrahedra.isInfinite(cell)) continue;
    for (int side = 0; side < 4; ++side) {
      if (tetrahedra.isInfinite(cell, side)) continue;
      // Counter-clockwise from outside the infinite cell: from within the hull.
      const auto [a, b, c] = tetrahedra.side(cell, side);
      const auto& points = tetrahedra.points;
      const Eigen::Vector3d inward = (points[b] - points[a]).cross(points[c] - points[a]);
      if (inward.dot(points[a] - camera) <= 0.0) continue;
      Facet facet{{}, {cell, side}};
      bool ahead = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto spot = inPicture(points[std::array{a, b, c}[i]] - camera);
        ahead = ahead && spot.has_value();
        if (spot) facet.corners[i] = *spot;
      }
      if (!ahead) continue;
      for (const Eigen::Vector2d& corner : facet.corners) {
        low_ = low_.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      facets_.push_back(facet);
    }
  }
  if (facets_.empty()) return;
  buckets_per_unit_ = (high - low_).cwiseMax(1e-300).cwiseInverse() * kBuckets;
  grid_.resize(std::size_t{kBuckets} * kBuckets);
  for (std::uint32_t facet = 0; facet < facets_.size(); ++facet) addToGrid(facet);
}

std::optional<Eigen::Vector2d> HullEntry::inPicture(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d turned = picture_from_table_ * direction;
  if (turned.z() < kLeastForward * turned.norm()) return std::nullopt;
  return Eigen::Vector2d(turned.x() / turned.z(), turned.y() / turned.z());
}

std::array<int, 2> HullEntry::bucketOf(const Eigen::Vector2d& spot) const {
  const Eigen::Vector2d at = (spot - low_).cwiseProduct(buckets_per_unit_);
  const auto bucket = [](double value) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, kBuckets - 1.0));
  };
  return {bucket(at.x()), bucket(at.y())};
}

void HullEntry::addToGrid(std::uint32_t facet) {
  const auto& [a, b, c] = facets_[facet].corners;
  const auto first = bucketOf(a.cwiseMin(b).cwiseMin(c));
  const auto last = bucketOf(a.cwiseMax(b).cwiseMax(c));
  for (int y = first[1]; y <= last[1]; ++y) {
    for (int x = first[0]; x <= last[0]; ++x) {
      grid_[static_cast<std::size_t>(y * kBuckets + x)].push_back(facet);
    }
  }
}

std::optional<HullEntry::Place> HullEntry::of(const Eigen::Vector3d& direction) const {
  const auto spot = inPicture(direction);
  if (!spot || grid_.empty()) return std::nullopt;
  const auto [x, y] = bucketOf(*spot);
  for (const std::uint32_t number : grid_[static_cast<std::size_t>(y * kBuckets + x)]) {
    const auto& [a, b, c] = facets_[number].corners;
    const double area = cross(b - a, c - a);
    const double u = cross(b - *spot, c - *spot) / area;
    const double v = cross(c - *spot, a - *spot) / area;
    if (u >= kOnEdge && v >= kOnEdge && 1.0 - u - v >= kOnEdge) return facets_[number].place;
  }
  return std::nullopt;
}

}  // namespace gyre
