// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_surface.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/local_surface.h"

namespace gyre {
namespace {

// Points whose normals differ by more belong to the far side of a wall, or to another face.
constexpr double kLeastCosine = 0.3;

}  // namespace

std::vector<PointSurface> pointSurfaces(const PointCloud& cloud, std::size_t first,
                                        std::size_t neighbours) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  const KdTree points(std::move(positions));
  std::vector<PointSurface> surfaces(points.size() - first);
  parallelFor(surfaces.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& point = cloud.points[first + i];
      auto near = points.nearest(point.position, neighbours);
      std::erase_if(near, [&](const KdTree::Neighbour& each) {
        return cloud.points[each.index].normal.dot(point.normal) < kLeastCosine;
      });
      const auto surface = fitLocalSurface(points, point.position, near);
      if (!surface) continue;
      surfaces[i].reach_mm = std::sqrt(near.back().squared_mm2);
      const double side = surface->normal.dot(point.normal) < 0.0 ? -1.0 : 1.0;
      surfaces[i].normal = side * surface->normal;
      surfaces[i].bending = side * surface->bending;
      surfaces[i].scatter_mm = surface->scatter_mm;
    }
  });
  return surfaces;
}

}  // namespace gyre
