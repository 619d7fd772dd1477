// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/kd_tree.h"
#include "core/mesh/point_normals.h"
#include "core/mesh/settle_points.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

// Of the local spacing: points nearer than this tell little more and make thin triangles.
constexpr double kThinningShare = 0.5;
// Of a point's sigma along its normal: points nearer than this make a rough sheet, not a smooth
// one.
constexpr double kSpacingSigmas = 6.0;

Error tooFew() {
  return {Error::Code::kTooFew, "A surface needs at least four points in different places.",
          "Scan the object from more views, or with more texture on it."};
}

Result<void> check(const PointCloud& cloud) {
  if (cloud.points.size() < 4) return tooFew();
  for (const Point& point : cloud.points) {
    if (!point.position.allFinite() || !point.normal.allFinite() || !point.covariance.allFinite()) {
      return Error{Error::Code::kInvalidInput, "The cloud holds a coordinate that is not a number.",
                   "Write the points again with finite coordinates."};
    }
  }
  return {};
}

bool lacksNormals(const PointCloud& cloud) {
  return std::all_of(cloud.points.begin(), cloud.points.end(),
                     [](const Point& point) { return point.normal.isZero(); });
}

}  // namespace

std::vector<Eigen::Vector3d> positionsOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return positions;
}

Result<PointCloud> settledCloud(const PointCloud& cloud, const Task& task) {
  if (const Result<void> valid = check(cloud); !valid) return valid.error();
  task.report(0.0, "Smoothing the points");
  if (!lacksNormals(cloud)) return settlePoints(cloud, KdTree(positionsOf(cloud)), task);
  PointCloud with_normals = cloud;
  const Result<void> set = setPointNormals(with_normals, {}, {}, task.part(0.0, 0.5));
  if (!set) return set.error();
  if (lacksNormals(with_normals)) return tooFew();
  return settlePoints(with_normals, KdTree(positionsOf(with_normals)), task.part(0.5, 1.0));
}

Result<SurfacePoints> surfacePoints(const PointCloud& cloud, double spacing_mm, const Task& task) {
  auto settled = settledCloud(cloud, task.part(0.0, 0.6));
  if (!settled) return settled.error();
  if (settled->points.size() < 4) return tooFew();
  const KdTree tree(positionsOf(*settled));
  const std::vector<double> spacing = localSpacing(tree);
  std::vector<double> radius_mm;
  std::vector<double> cost;
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    const Point& point = settled->points[i];
    radius_mm.push_back(std::max(
        {spacing_mm, kThinningShare * spacing[i], kSpacingSigmas * sigmaAlongNormal(point)}));
    cost.push_back(point.sigmaMm());
    normals.push_back(point.normal);
  }
  if (task.stopRequested()) return cancelled();
  task.report(0.8, "Thinning the points");
  SurfacePoints even;
  for (const std::uint32_t kept : thinPoints(tree, {cost, normals, radius_mm})) {
    even.cloud.points.push_back(std::move(settled->points[kept]));
  }
  if (even.cloud.points.size() < 4) return tooFew();
  even.spacing_mm = localSpacing(KdTree(positionsOf(even.cloud)));
  return even;
}

double sigmaAlongNormal(const Point& point) {
  return std::sqrt(std::max(0.0, point.normal.dot(point.covariance * point.normal)));
}

std::vector<std::uint32_t> spreadViews(const Point& point, std::size_t known, std::size_t count) {
  std::vector<std::uint32_t> views;
  for (const std::uint32_t view : point.views) {
    if (view < known) views.push_back(view);
  }
  if (views.size() <= count) return views;
  std::vector<std::uint32_t> spread;
  for (std::size_t i = 0; i < count; ++i) spread.push_back(views[i * views.size() / count]);
  return spread;
}

MeshVertex vertexOf(const Point& point) {
  MeshVertex vertex;
  vertex.position = point.position;
  vertex.normal = point.normal;
  vertex.rgb = point.rgb;
  vertex.sigma_mm = static_cast<float>(point.sigmaMm());
  vertex.views = static_cast<std::uint16_t>(std::min<std::size_t>(point.views.size(), 65535));
  return vertex;
}

}  // namespace gyre
