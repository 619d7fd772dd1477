// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/median.h"
#include "core/mesh/alpha_facets.h"
#include "core/mesh/components.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/manifold_selection.h"
#include "core/mesh/point_normals.h"
#include "core/mesh/settle_points.h"
#include "core/mesh/small_holes.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

// Balls smaller than alpha come first: they follow clefts that alpha would bridge, and leave to the
// larger ones only the gaps of sparse regions.
constexpr std::array<double, 3> kAlphaLadder = {0.35, 0.6, 1.0};
// Thinned to this share of the spacing, the denser half of the surface becomes even and the sparser
// half keeps its points. Points nearer than some sigmas would make a rough sheet, not a smooth one.
constexpr double kSpacingShare = 0.8;
constexpr double kSpacingSigmas = 5.0;
// Gaps up to this perimeter are closed: a ball of radius alpha cannot fall through them.
constexpr double kHolePerimeterAlphas = 3.0;
// Cosine between a facet and the normals of its corners, below which it is a wall across a gap or
// the side of a sliver.
constexpr double kMinAgreement = 0.2;

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

KdTree treeOf(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  return KdTree(std::move(positions));
}

bool lacksNormals(const PointCloud& cloud) {
  return std::all_of(cloud.points.begin(), cloud.points.end(),
                     [](const Point& point) { return point.normal.isZero(); });
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

// Makes the settled points even; sets the spacing and the vertices of the shape.
Result<void> placeVertices(const PointCloud& cloud, double wanted_spacing_mm,
                           AlphaShapeMesh& shape) {
  if (cloud.points.size() < 4) return tooFew();
  const KdTree tree = treeOf(cloud);
  std::vector<double> sigma_mm;
  std::vector<Eigen::Vector3d> normals;
  for (const Point& point : cloud.points) {
    sigma_mm.push_back(point.sigmaMm());
    normals.push_back(point.normal);
  }
  shape.spacing_mm = wanted_spacing_mm;
  if (shape.spacing_mm == 0.0) {
    shape.spacing_mm = std::max(kSpacingShare * spacingQuantile(localSpacing(tree), 0.5),
                                kSpacingSigmas * median(sigma_mm));
  }
  if (!(shape.spacing_mm > 0.0)) return tooFew();
  for (const std::uint32_t kept : thinPoints(tree, {sigma_mm, normals}, shape.spacing_mm)) {
    shape.mesh.vertices.push_back(vertexOf(cloud.points[kept]));
  }
  return {};
}

// Facets whose outer side is the one that their corners' normals look to.
void addOutwardFacets(const std::vector<AlphaFacet>& facets, int level,
                      const std::vector<MeshVertex>& vertices,
                      std::vector<TriangleCandidate>& candidates) {
  for (const AlphaFacet& facet : facets) {
    const auto& [a, b, c] = facet.corners;
    const Eigen::Vector3d ab = vertices[b].position - vertices[a].position;
    const Eigen::Vector3d ac = vertices[c].position - vertices[a].position;
    const Eigen::Vector3d normals = vertices[a].normal + vertices[b].normal + vertices[c].normal;
    const double agreement = ab.cross(ac).stableNormalized().dot(normals) / 3.0;
    if (agreement > kMinAgreement) {
      candidates.push_back({facet.corners, level, facet.radius_mm});
    } else if (facet.both_sides && agreement < -kMinAgreement) {
      candidates.push_back({{a, c, b}, level, facet.radius_mm});
    }
  }
}

// Spans the vertices of the shape with triangles.
Result<void> placeTriangles(AlphaShapeMesh& shape) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(shape.mesh.vertices.size());
  for (const MeshVertex& vertex : shape.mesh.vertices) places.push_back(vertex.position);
  std::vector<double> alphas_mm;
  alphas_mm.reserve(std::size(kAlphaLadder));
  for (const double step : kAlphaLadder) alphas_mm.push_back(step * shape.alpha_mm);
  const auto facets = outerAlphaFacets(places, alphas_mm);
  if (!facets) return facets.error();
  std::vector<TriangleCandidate> candidates;
  for (std::size_t level = 0; level < facets->size(); ++level) {
    addOutwardFacets((*facets)[level], static_cast<int>(level), shape.mesh.vertices, candidates);
  }
  shape.mesh.triangles = selectManifold(std::move(candidates));
  closeSmallHoles(shape.mesh, {.max_perimeter_mm = kHolePerimeterAlphas * shape.alpha_mm});
  return {};
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

  task.report(0.0, "Smoothing the points");
  const Result<PointCloud> settled = settlePoints(cloud, treeOf(cloud), task);
  if (!settled) return settled.error();

  AlphaShapeMesh shape;
  const Result<void> thinned = placeVertices(*settled, options.spacing_mm, shape);
  if (!thinned) return thinned.error();
  shape.alpha_mm =
      options.alpha_mm > 0.0 ? options.alpha_mm : options.alpha_spacings * shape.spacing_mm;
  if (task.stopRequested()) return cancelled();

  task.report(0.5, "Building the surface");
  const Result<void> spanned = placeTriangles(shape);
  if (!spanned) return spanned.error();
  removeSmallComponents(shape.mesh, options.min_component_share);
  if (shape.mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The points lie too far apart to make a surface.",
                 "Choose a larger alpha, or scan the object with more texture on it."};
  }
  computeNormals(shape.mesh);
  if (task.stopRequested()) return cancelled();
  task.report(1.0, "Surface made");
  return shape;
}

}  // namespace gyre
