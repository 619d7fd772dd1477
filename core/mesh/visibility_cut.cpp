// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/visibility_cut.h"

#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/mesh/base_on_table.h"
#include "core/mesh/components.h"
#include "core/mesh/free_space.h"
#include "core/mesh/max_flow.h"
#include "core/mesh/solid_cells.h"
#include "core/mesh/surface_points.h"
#include "core/mesh/tetrahedra.h"
#include "core/mesh/unseen_facets.h"

namespace gyre {
namespace {

constexpr int kMaxRounds = 10;

// Fails where no point knows a camera that saw it, or more than a fifth of the sights come from
// behind.
Result<void> checkSights(const PointCloud& cloud, const SightEvidence& evidence) {
  std::size_t sights = 0;
  std::size_t facing = 0;
  for (const Point& point : cloud.points) {
    for (const std::uint32_t view : point.views) {
      if (view >= evidence.camera_centres.size()) continue;
      ++sights;
      const Eigen::Vector3d towards = evidence.camera_centres[view] - point.position;
      if (point.normal.dot(towards) >= 0.0) ++facing;
    }
  }
  if (sights == 0) {
    return Error{Error::Code::kInvalidInput,
                 "It is not known which views saw the points, so no line of sight can be followed.",
                 "Reconstruct again, or choose the alpha shape, which needs the points alone."};
  }
  if (5 * facing < 4 * sights) {
    return Error{Error::Code::kInvalidInput,
                 "Many points look away from the cameras that are said to have seen them.",
                 "Points, views, angles and calibration must come from one reconstruction: "
                 "reconstruct again, or choose the alpha shape, which needs the points alone."};
  }
  return {};
}

SolidCells solidCells(const Tetrahedra& tetrahedra, const CellCut& cut, double min_share) {
  SolidCells solid;
  solid.reserve(cut.on_source_side.size());
  for (const char outside : cut.on_source_side) solid.push_back(outside ? 0 : 1);
  // Each step may leave the next something to do; in practice two rounds are enough.
  for (int round = 0; round < kMaxRounds; ++round) {
    const SolidCells before = solid;
    fillCavities(tetrahedra, solid);
    freeCrumbs(tetrahedra, min_share, solid);
    makeManifold(tetrahedra, solid);
    if (solid == before) break;
  }
  return solid;
}

}  // namespace

Result<VisibilityCutMesh> visibilityCut(const PointCloud& cloud, const SightEvidence& evidence,
                                        const VisibilityCutOptions& options, const Task& task) {
  if (const auto valid = options.validate(); !valid) return valid.error();
  if (const auto known = checkSights(cloud, evidence); !known) return known.error();
  const auto points = surfacePoints(cloud, options.spacing_mm, task.part(0.0, 0.2));
  if (!points) return points.error();
  const auto tetrahedra = delaunay(positionsOf(points->cloud), task.part(0.2, 0.4));
  if (!tetrahedra) return tetrahedra.error();
  auto graph = freeSpaceGraph(*tetrahedra, *points, evidence, options, task.part(0.4, 0.7));
  if (!graph) return graph.error();
  task.report(0.7, "Dividing inside from outside");
  const auto cut = minimumCut(std::move(*graph), task.part(0.7, 0.9));
  if (!cut) return cut.error();

  VisibilityCutMesh result;
  result.spacing_mm = median(points->spacing_mm);
  const SolidCells solid = solidCells(*tetrahedra, *cut, options.min_component_share);
  result.mesh.triangles = wallOf(*tetrahedra, solid);
  if (result.mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The lines of sight leave nothing solid.",
                 "Check that points and calibration belong together; scan from more views."};
  }
  result.mesh.vertices.reserve(points->cloud.points.size());
  for (const Point& point : points->cloud.points) result.mesh.vertices.push_back(vertexOf(point));
  std::vector<double> spacing_mm = points->spacing_mm;
  restOnTable(result.mesh, spacing_mm);
  markWideFacets(result.mesh, spacing_mm);
  removeUnusedVertices(result.mesh);
  computeNormals(result.mesh);
  if (task.stopRequested()) return cancelled();
  task.report(1.0, "Surface made");
  return result;
}

}  // namespace gyre
