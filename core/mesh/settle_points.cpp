// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/settle_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/mesh/local_surface.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

constexpr std::size_t kNeighbours = 24;
constexpr double kSameSide = 0.5;          // cosine between normals
constexpr double kMaxMoveSigmas = 3.0;     // of the point
constexpr double kMaxMoveSpacings = 0.25;  // of the local spacing
constexpr double kOutlierSigmas = 5.0;     // beyond both of these a point is an outlier
constexpr double kOutlierSpacings = 0.5;

// The point, moved; nothing when it is an outlier.
std::optional<Point> settled(const PointCloud& cloud, const KdTree& tree, std::uint32_t index,
                             double spacing_mm) {
  const Point& point = cloud.points[index];
  auto neighbours = tree.nearest(point.position, kNeighbours);
  std::erase_if(neighbours, [&](const KdTree::Neighbour& neighbour) {
    return cloud.points[neighbour.index].normal.dot(point.normal) < kSameSide;
  });
  const auto surface = fitLocalSurface(tree, point.position, neighbours);
  if (!surface) return point;
  const double sigma_mm = point.sigmaMm();

  // Its own weight draws the surface to an outlier, so that one is judged without it.
  std::erase_if(neighbours,
                [&](const KdTree::Neighbour& neighbour) { return neighbour.index == index; });
  if (const auto others = fitLocalSurface(tree, point.position, neighbours)) {
    const double off_mm = (others->foot - point.position).norm();
    if (off_mm > std::max(kOutlierSigmas * sigma_mm, kOutlierSpacings * spacing_mm)) {
      return std::nullopt;
    }
  }
  double limit_mm = kMaxMoveSpacings * spacing_mm;
  if (sigma_mm > 0.0) limit_mm = std::min(limit_mm, kMaxMoveSigmas * sigma_mm);
  const Eigen::Vector3d move = surface->foot - point.position;
  const double length_mm = move.norm();
  Point moved = point;
  if (length_mm > 0.0) moved.position += move * std::min(1.0, limit_mm / length_mm);
  return moved;
}

}  // namespace

Result<PointCloud> settlePoints(const PointCloud& cloud, const KdTree& tree, const Task& task) {
  const std::vector<double> spacing_mm = localSpacing(tree);
  std::vector<std::optional<Point>> points(tree.size());
  parallelFor(tree.size(), 128, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      points[i] = settled(cloud, tree, static_cast<std::uint32_t>(i), spacing_mm[i]);
    }
  });
  if (task.stopRequested()) return cancelled();
  PointCloud kept;
  kept.points.reserve(points.size());
  for (std::optional<Point>& point : points) {
    if (point) kept.points.push_back(std::move(*point));
  }
  return kept;
}

}  // namespace gyre
