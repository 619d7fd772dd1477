// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/parallel.h"
#include "core/mesh/alpha_facets.h"
#include "core/mesh/components.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/local_surface.h"
#include "core/mesh/manifold_selection.h"
#include "core/mesh/point_normals.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

constexpr std::size_t kFitNeighbours = 24;
constexpr double kSpacingShare = 0.8;
constexpr double kSpacingSigmas = 8.0;
constexpr double kMaxMoveSigmas = 3.0;
constexpr double kMaxMoveSpacings = 0.25;
constexpr double kMinAgreement = 0.2;

Error tooFew() {
  return {Error::Code::kTooFew, "A surface needs at least four points in different places.",
          "Scan the object from more views, or with more texture on it."};
}

Result<void> check(const PointCloud& cloud) {
  if (cloud.points.size() < 4) return tooFew();
  for (const Point& point : cloud.points) {
    if (!point.position.allFinite() || !point.normal.allFinite()) {
      return Error{Error::Code::kInvalidInput, "The cloud holds a coordinate that is not a number.",
                   "Write the points again with finite coordinates."};
    }
  }
  return {};
}

std::vector<Eigen::Vector3d> positionsOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return positions;
}

bool lacksNormals(const PointCloud& cloud) {
  return std::all_of(cloud.points.begin(), cloud.points.end(),
                     [](const Point& point) { return point.normal.isZero(); });
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The point as a vertex, moved onto the surface that its neighbours suggest: along the normal, and
// no farther than its own uncertainty explains.
MeshVertex settledVertex(const Point& point, const KdTree& all, double spacing_mm) {
  MeshVertex vertex;
  vertex.position = point.position;
  vertex.normal = point.normal;
  vertex.rgb = point.rgb;
  vertex.sigma_mm = static_cast<float>(point.sigmaMm());
  vertex.views = static_cast<std::uint16_t>(std::min<std::size_t>(point.views.size(), 65535));
  const auto neighbours = all.nearest(point.position, kFitNeighbours);
  const auto surface = fitLocalSurface(all, point.position, neighbours);
  if (!surface) return vertex;
  const double sigma_mm = point.sigmaMm();
  double limit_mm = kMaxMoveSpacings * spacing_mm;
  if (sigma_mm > 0.0) limit_mm = std::min(limit_mm, kMaxMoveSigmas * sigma_mm);
  const Eigen::Vector3d move = surface->foot - point.position;
  const double length_mm = move.norm();
  if (length_mm > 0.0) vertex.position += move * std::min(1.0, limit_mm / length_mm);
  return vertex;
}

// Facets whose outer side is the one that their corners' normals look to.
std::vector<TriangleCandidate> outwardFacets(const std::vector<AlphaFacet>& facets,
                                             const std::vector<MeshVertex>& vertices) {
  std::vector<TriangleCandidate> candidates;
  for (const AlphaFacet& facet : facets) {
    const auto& [a, b, c] = facet.corners;
    const Eigen::Vector3d ab = vertices[b].position - vertices[a].position;
    const Eigen::Vector3d ac = vertices[c].position - vertices[a].position;
    const Eigen::Vector3d normals = vertices[a].normal + vertices[b].normal + vertices[c].normal;
    const double agreement = ab.cross(ac).stableNormalized().dot(normals) / 3.0;
    if (agreement > kMinAgreement) {
      candidates.push_back({facet.corners, facet.radius_mm});
    } else if (facet.both_sides && agreement < -kMinAgreement) {
      candidates.push_back({{a, c, b}, facet.radius_mm});
    }
  }
  return candidates;
}

}  // namespace

Result<AlphaShapeMesh> alphaShapeMesh(const PointCloud& cloud, const AlphaShapeOptions& options,
                                      const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> valid = check(cloud); !valid) return valid.error();
  if (lacksNormals(cloud)) {
    PointCloud with_normals = cloud;
    const Result<void> set = setPointNormals(with_normals, {}, {}, task.part(0.0, 0.2));
    if (!set) return set.error();
    if (lacksNormals(with_normals)) return tooFew();
    return alphaShapeMesh(with_normals, options, task.part(0.2, 1.0));
  }

  task.report(0.0, "Thinning the points");
  const KdTree all(positionsOf(cloud));
  std::vector<double> sigma_mm(cloud.points.size());
  std::transform(cloud.points.begin(), cloud.points.end(), sigma_mm.begin(),
                 [](const Point& point) { return point.sigmaMm(); });
  AlphaShapeMesh shape;
  shape.spacing_mm = options.spacing_mm;
  if (shape.spacing_mm == 0.0) {
    shape.spacing_mm = std::max(kSpacingShare * spacingQuantile(localSpacing(all), 0.5),
                                kSpacingSigmas * median(sigma_mm));
  }
  if (!(shape.spacing_mm > 0.0)) return tooFew();
  const std::vector<std::uint32_t> kept = thinPoints(all, sigma_mm, shape.spacing_mm);
  shape.alpha_mm =
      options.alpha_mm > 0.0 ? options.alpha_mm : options.alpha_spacings * shape.spacing_mm;

  task.report(0.2, "Smoothing the points");
  shape.mesh.vertices.resize(kept.size());
  parallelFor(kept.size(), 128, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      shape.mesh.vertices[i] = settledVertex(cloud.points[kept[i]], all, shape.spacing_mm);
    }
  });
  if (task.stopRequested()) return cancelled();

  task.report(0.5, "Building the surface");
  std::vector<Eigen::Vector3d> places;
  for (const MeshVertex& vertex : shape.mesh.vertices) places.push_back(vertex.position);
  const auto facets = outerAlphaFacets(places, shape.alpha_mm);
  if (!facets) return facets.error();
  if (task.stopRequested()) return cancelled();
  shape.mesh.triangles = selectManifold(outwardFacets(*facets, shape.mesh.vertices));
  removeSmallComponents(shape.mesh, options.min_component_share);
  removeUnusedVertices(shape.mesh);
  if (shape.mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The points lie too far apart to make a surface.",
                 "Choose a larger alpha, or scan the object with more texture on it."};
  }
  computeNormals(shape.mesh);
  task.report(1.0, "Surface made");
  return shape;
}

}  // namespace gyre
