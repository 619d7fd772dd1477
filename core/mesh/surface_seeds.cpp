// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_seeds.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace gyre {
namespace {

// Shares of the spacing. A place that was tried in vain may be tried again from elsewhere, where
// the surface may be known better, but not endlessly.
constexpr double kPointsApart = 0.75;
constexpr double kGivenApart = 0.5;
constexpr int kAround = 6;
// A quadric that turns away by more than this within one spacing foretells nothing. [cosine]
constexpr double kLeastTurn = 0.7;

Eigen::Vector3i cellAt(const Eigen::Vector3d& position, double side_mm) {
  return (position / side_mm).array().floor().cast<int>();
}

}  // namespace

SurfaceSeeds::SurfaceSeeds(double spacing_mm) : spacing_mm_(spacing_mm) {}

std::uint64_t SurfaceSeeds::cellOf(const Eigen::Vector3i& cell) const {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    key = (key << 21U) | (static_cast<std::uint64_t>(cell[axis] + (1 << 20)) & 0x1FFFFFU);
  }
  return key;
}

bool SurfaceSeeds::crowded(const Cells& cells, const Taken& place, double distance_mm) const {
  const Eigen::Vector3i middle = cellAt(place.position, spacing_mm_);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i cell = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto found = cells.find(cellOf(cell));
    if (found == cells.end()) continue;
    for (const Taken& other : found->second) {
      if ((other.position - place.position).squaredNorm() < distance_mm * distance_mm &&
          other.normal.dot(place.normal) >= 0.0) {
        return true;
      }
    }
  }
  return false;
}

void SurfaceSeeds::add(Cells& cells, const Taken& place) {
  cells[cellOf(cellAt(place.position, spacing_mm_))].push_back(place);
}

void SurfaceSeeds::occupy(const Point& point) { add(points_, {point.position, point.normal}); }

bool SurfaceSeeds::take(const Point& point) {
  if (crowded(points_, {point.position, point.normal}, kPointsApart * spacing_mm_)) return false;
  occupy(point);
  return true;
}

std::vector<SurfaceSeed> SurfaceSeeds::around(const PointCloud& cloud, std::size_t first,
                                              std::span<const PointSurface> surfaces) {
  std::vector<SurfaceSeed> seeds;
  for (std::size_t i = first; i < cloud.points.size(); ++i) {
    const Point& point = cloud.points[i];
    const PointSurface& surface = surfaces[i - first];
    if (point.normal.isZero() || surface.reach_mm == 0.0) continue;
    const Eigen::Vector3d u = point.normal.unitOrthogonal();
    const Eigen::Vector3d v = point.normal.cross(u);
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      const Eigen::Vector3d offset = spacing_mm_ * (std::cos(angle) * u + std::sin(angle) * v);
      const Eigen::Vector3d bent = surface.bending * offset;
      SurfaceSeed seed;
      seed.position = point.position + offset + 0.5 * offset.dot(bent) * point.normal;
      seed.normal = (point.normal - bent).normalized();
      if (seed.normal.dot(point.normal) < kLeastTurn) continue;
      seed.bending = surface.bending;
      seed.parent = static_cast<std::uint32_t>(i);
      const Taken place{seed.position, seed.normal};
      if (crowded(points_, place, kPointsApart * spacing_mm_) ||
          crowded(given_, place, kGivenApart * spacing_mm_)) {
        continue;
      }
      add(given_, place);
      seeds.push_back(seed);
    }
  }
  return seeds;
}

}  // namespace gyre
