// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/ray_walk.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr double kInside = -1e-9;  // sine of the angle by which a direction may miss a cell

struct SidePlane {
  Eigen::Vector3d outward;  // as long as twice the side's area
  const Eigen::Vector3d* corner;
};

SidePlane planeOf(const Tetrahedra& tetrahedra, std::uint32_t cell, int side) {
  const auto [a, b, c] = tetrahedra.side(cell, side);
  const auto& points = tetrahedra.points;
  return {(points[b] - points[a]).cross(points[c] - points[a]), &points[a]};
}

}  // namespace

CellExit exitOf(const Tetrahedra& tetrahedra, std::uint32_t cell, const Ray& ray, int entry) {
  CellExit exit;
  for (int side = 0; side < 4; ++side) {
    if (side == entry) continue;
    const SidePlane plane = planeOf(tetrahedra, cell, side);
    const double along = plane.outward.dot(ray.direction);
    if (along <= 0.0) continue;
    const double distance_mm = plane.outward.dot(*plane.corner - ray.origin) / along;
    if (exit.side < 0 || distance_mm < exit.distance_mm) exit = {side, distance_mm};
  }
  if (exit.side < 0) exit.side = entry == 0 ? 1 : 0;  // a cell without volume: end the walk here
  return exit;
}

std::optional<std::uint32_t> cellTowards(const Tetrahedra& tetrahedra, const CellsAround& around,
                                         std::uint32_t point, const Eigen::Vector3d& direction) {
  std::optional<std::uint32_t> best;
  double most_inside = kInside;
  for (const std::uint32_t cell : around.of(point)) {
    if (tetrahedra.isInfinite(cell)) continue;
    double inside = 1.0;
    for (int side = 0; side < 4 && inside > most_inside; ++side) {
      if (tetrahedra.corners[cell][static_cast<std::size_t>(side)] == point) continue;
      const Eigen::Vector3d outward = planeOf(tetrahedra, cell, side).outward.stableNormalized();
      inside = std::min(inside, -outward.dot(direction));
    }
    if (inside > most_inside) {
      most_inside = inside;
      best = cell;
    }
  }
  return best;
}

}  // namespace gyre
