// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_bending.h"

#include "core/base/parallel.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/local_surface.h"

namespace gyre {
namespace {

// Points whose normals differ by more belong to the far side of a wall, or to another face.
constexpr double kLeastCosine = 0.3;

}  // namespace

std::vector<Eigen::Matrix3d> pointBending(const PointCloud& cloud, std::size_t neighbours) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  const KdTree points(std::move(positions));
  std::vector<Eigen::Matrix3d> bending(points.size(), Eigen::Matrix3d::Zero());
  parallelFor(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& point = cloud.points[i];
      auto near = points.nearest(point.position, neighbours);
      std::erase_if(near, [&](const KdTree::Neighbour& each) {
        return cloud.points[each.index].normal.dot(point.normal) < kLeastCosine;
      });
      const auto surface = fitLocalSurface(points, point.position, near);
      if (!surface) continue;
      bending[i] = surface->normal.dot(point.normal) < 0.0 ? -surface->bending : surface->bending;
    }
  });
  return bending;
}

}  // namespace gyre
