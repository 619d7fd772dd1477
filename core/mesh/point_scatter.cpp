// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_scatter.h"

#include <cstddef>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/point_surface.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 256;
// Of these the nearest that looks the same way speaks for a point.
constexpr std::size_t kAsked = 6;

PointCloud thinned(const PointCloud& cloud, double apart_mm) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> sigma_mm;
  for (const Point& point : cloud.points) {
    positions.push_back(point.position);
    normals.push_back(point.normal);
    sigma_mm.push_back(point.sigmaMm());
  }
  PointCloud thin;
  const std::vector<double> radius_mm(positions.size(), apart_mm);
  for (const std::uint32_t i : thinPoints(KdTree(positions), {sigma_mm, normals, radius_mm})) {
    thin.points.push_back(cloud.points[i]);
  }
  return thin;
}

}  // namespace

std::vector<double> pointScatter(const PointCloud& cloud, const ScatterReach& reach) {
  const PointCloud thin = thinned(cloud, reach.apart_mm);
  const std::vector<PointSurface> surfaces = pointSurfaces(thin);
  std::vector<Eigen::Vector3d> positions;
  for (const Point& point : thin.points) positions.push_back(point.position);
  const KdTree tree(std::move(positions));
  std::vector<double> scatter_mm(cloud.points.size(), 0.0);
  parallelFor(scatter_mm.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& point = cloud.points[i];
      for (const KdTree::Neighbour& near : tree.nearest(point.position, kAsked)) {
        if (thin.points[near.index].normal.dot(point.normal) <= 0.0) continue;
        const PointSurface& surface = surfaces[near.index];
        if (surface.reach_mm <= reach.most_mm) scatter_mm[i] = surface.scatter_mm;
        break;
      }
    }
  });
  return scatter_mm;
}

}  // namespace gyre
