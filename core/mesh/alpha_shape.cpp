// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_shape.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/mesh/components.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/outward_facets.h"
#include "core/mesh/small_holes.h"
#include "core/mesh/surface_points.h"
#include "core/mesh/thin_points.h"

namespace gyre {
namespace {

// Thinned to this share of the spacing, the denser half of the surface becomes even and the sparser
// half keeps its points. Points nearer than some sigmas would make a rough sheet, not a smooth one.
constexpr double kSpacingShare = 0.8;
constexpr double kSpacingSigmas = 5.0;
// Gaps up to this perimeter are closed: a ball of radius alpha cannot fall through them.
constexpr double kHolePerimeterAlphas = 3.0;
Error tooFew() {
  return {Error::Code::kTooFew, "A surface needs at least four points in different places.",
          "Scan the object from more views, or with more texture on it."};
}

// The spacing to thin to.
double evenSpacing(const PointCloud& cloud, const KdTree& tree) {
  std::vector<double> sigma_mm;
  sigma_mm.reserve(cloud.points.size());
  for (const Point& point : cloud.points) sigma_mm.push_back(point.sigmaMm());
  return std::max(kSpacingShare * spacingQuantile(localSpacing(tree), 0.5),
                  kSpacingSigmas * median(sigma_mm));
}

std::vector<MeshVertex> thinned(const PointCloud& cloud, const KdTree& tree, double spacing_mm) {
  std::vector<double> sigma_mm;
  std::vector<Eigen::Vector3d> normals;
  for (const Point& point : cloud.points) {
    sigma_mm.push_back(point.sigmaMm());
    normals.push_back(point.normal);
  }
  const std::vector<double> radius_mm(cloud.points.size(), spacing_mm);
  std::vector<MeshVertex> vertices;
  for (const std::uint32_t kept : thinPoints(tree, {sigma_mm, normals, radius_mm})) {
    vertices.push_back(vertexOf(cloud.points[kept]));
  }
  return vertices;
}

}  // namespace

AlphaShape::AlphaShape(std::vector<MeshVertex> vertices, AlphaFiltration filtration)
    : vertices_(std::move(vertices)), filtration_(std::move(filtration)) {}

Result<AlphaShape> AlphaShape::prepare(const PointCloud& cloud, const AlphaShapeOptions& options,
                                       const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  const Result<PointCloud> settled = settledCloud(cloud, task.part(0.0, 0.5));
  if (!settled) return settled.error();
  if (settled->points.size() < 4) return tooFew();
  const KdTree tree(positionsOf(*settled));
  const double spacing_mm =
      options.spacing_mm > 0.0 ? options.spacing_mm : evenSpacing(*settled, tree);
  if (!(spacing_mm > 0.0)) return tooFew();
  std::vector<MeshVertex> vertices = thinned(*settled, tree, spacing_mm);
  std::vector<Eigen::Vector3d> places;
  places.reserve(vertices.size());
  for (const MeshVertex& vertex : vertices) places.push_back(vertex.position);
  auto tetrahedra = delaunay(std::move(places), task.part(0.5, 0.9));
  if (!tetrahedra) return tetrahedra.error();
  AlphaShape shape(std::move(vertices), AlphaFiltration(std::move(*tetrahedra)));
  shape.spacing_mm_ = spacing_mm;
  shape.automatic_alpha_mm_ = options.alpha_spacings * spacing_mm;
  shape.min_component_share_ = options.min_component_share;
  if (task.stopRequested()) return cancelled();
  return shape;
}

Result<AlphaShapeMesh> AlphaShape::at(double alpha_mm) const {
  AlphaShapeMesh shape;
  shape.alpha_mm = alpha_mm;
  shape.spacing_mm = spacing_mm_;
  shape.mesh.vertices = vertices_;
  shape.mesh.triangles =
      outwardFacets(filtration_, alpha_mm, vertices_, [](const AlphaFacet&) { return true; });
  closeSmallHoles(shape.mesh, {.max_perimeter_mm = kHolePerimeterAlphas * alpha_mm});
  removeSmallComponents(shape.mesh, min_component_share_);
  if (shape.mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The points lie too far apart to make a surface.",
                 "Choose a larger alpha, or scan the object with more texture on it."};
  }
  computeNormals(shape.mesh);
  return shape;
}

Result<AlphaShapeMesh> alphaShapeMesh(const PointCloud& cloud, const AlphaShapeOptions& options,
                                      const Task& task) {
  const auto shape = AlphaShape::prepare(cloud, options, task.part(0.0, 0.9));
  if (!shape) return shape.error();
  if (task.stopRequested()) return cancelled();
  task.report(0.9, "Building the surface");
  auto made = shape->at(options.alpha_mm > 0.0 ? options.alpha_mm : shape->automaticAlphaMm());
  if (task.stopRequested()) return cancelled();
  if (made) task.report(1.0, "Surface made");
  return made;
}

}  // namespace gyre
