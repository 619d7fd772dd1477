// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/adaptive_alpha.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/mesh/alpha_filtration.h"
#include "core/mesh/components.h"
#include "core/mesh/outward_facets.h"
#include "core/mesh/ray_walk.h"
#include "core/mesh/small_holes.h"
#include "core/mesh/surface_points.h"

namespace gyre {
namespace {

// A spacing counts the square that a point has to itself; thinned points lie a little nearer.
constexpr double kSpacingsPerAlpha = 0.8;
constexpr double kHolePerimeterAlphas = 3.0;
constexpr std::size_t kRaysPerPoint = 8;
constexpr std::uint32_t kPointsBetweenLooks = 1024;
constexpr std::uint8_t kCrossed = 2;  // so many lines of sight through a facet are no accident
constexpr double kToleranceSpacings = 1.0;  // so near to its point a line of sight says nothing

// Of each cell's sides, up to kCrossed.
using Crossings = std::vector<std::array<std::uint8_t, 4>>;

// How many lines of sight pass each side, in either direction; incomplete when stopped.
Crossings crossingsOf(const Tetrahedra& tetrahedra, const SurfacePoints& points,
                      const SightEvidence& sights, const Task& task) {
  Crossings crossings(tetrahedra.cells());
  const CellsAround around(tetrahedra);
  const auto count = [&](std::uint32_t cell, std::size_t side) {
    std::uint8_t& passed = crossings[cell][side];
    if (passed < kCrossed) ++passed;
  };
  for (std::uint32_t i = 0; i < points.cloud.points.size(); ++i) {
    if (i % kPointsBetweenLooks == 0 && task.stopRequested()) return crossings;
    const Point& point = points.cloud.points[i];
    for (const std::uint32_t view :
         spreadViews(point, sights.camera_centres.size(), kRaysPerPoint)) {
      const Eigen::Vector3d offset = sights.camera_centres[view] - point.position;
      const Ray ray{point.position, offset.normalized()};
      const auto start = cellTowards(tetrahedra, around, i, ray.direction);
      if (!start) continue;
      walkCells(tetrahedra, *start, ray, offset.norm(),
                [&](std::uint32_t cell, const CellExit& exit) {
                  if (exit.distance_mm < kToleranceSpacings * points.spacing_mm[i]) return;
                  const auto side = static_cast<std::size_t>(exit.side);
                  count(cell, side);
                  count(tetrahedra.neighbours[cell][side], tetrahedra.mirrors[cell][side]);
                });
    }
  }
  return crossings;
}

}  // namespace

Result<AlphaShapeMesh> adaptiveAlphaMesh(const PointCloud& cloud, const SightEvidence& sights,
                                         const AlphaShapeOptions& options, const Task& task) {
  if (const auto valid = options.validate(); !valid) return valid.error();
  const auto points = surfacePoints(cloud, options.spacing_mm, task.part(0.0, 0.3));
  if (!points) return points.error();
  auto tetrahedra = delaunay(positionsOf(points->cloud), task.part(0.3, 0.6));
  if (!tetrahedra) return tetrahedra.error();
  task.report(0.6, "Following lines of sight");
  const Crossings crossings = crossingsOf(*tetrahedra, *points, sights, task);
  if (task.stopRequested()) return cancelled();

  task.report(0.8, "Building the surface");
  const AlphaFiltration filtration(std::move(*tetrahedra), points->spacing_mm);
  AlphaShapeMesh shape;
  for (const Point& point : points->cloud.points) shape.mesh.vertices.push_back(vertexOf(point));
  const double alpha = kSpacingsPerAlpha * options.alpha_spacings;
  shape.mesh.triangles = outwardFacets(
      filtration, alpha, shape.mesh.vertices,
      [&](const AlphaFacet& facet) { return crossings[facet.cell][facet.side] < kCrossed; });
  const double widest_mm = *std::max_element(points->spacing_mm.begin(), points->spacing_mm.end());
  closeSmallHoles(shape.mesh, {.max_perimeter_mm = kHolePerimeterAlphas * alpha * widest_mm});
  removeSmallComponents(shape.mesh, options.min_component_share);
  if (shape.mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The points lie too far apart to make a surface.",
                 "Scan the object with more texture on it, or from more views."};
  }
  computeNormals(shape.mesh);
  shape.spacing_mm = median(points->spacing_mm);
  shape.alpha_mm = alpha * shape.spacing_mm;
  if (task.stopRequested()) return cancelled();
  task.report(1.0, "Surface made");
  return shape;
}

}  // namespace gyre
