// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/self_intersections.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/orient.h"
#include "core/mesh/clean/split_non_manifold.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Pairs = std::vector<std::array<std::uint32_t, 2>>;

}  // namespace

Result<Pairs> findSelfIntersections(const Mesh& mesh, const Task& task) {
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  if (task.stopRequested()) return cancelled();
  return guarded("The search for self-intersections", [&]() -> Result<Pairs> {
    const SurfaceMesh surface = surfaceMeshOf<SurfaceMesh>(mesh);
    std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    if (task.stopRequested()) return cancelled();
    Pairs pairs;
    pairs.reserve(found.size());
    for (const auto& [a, b] : found)
      pairs.push_back({std::min<std::uint32_t>(a, b), std::max<std::uint32_t>(a, b)});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  });
}

Result<std::size_t> countSelfIntersections(const Mesh& mesh, const Task& task) {
  if (checkSurface(mesh)) {
    const auto pairs = findSelfIntersections(mesh, task);
    if (!pairs) return pairs.error();
    return pairs->size();
  }
  const auto split = splitNonManifold(mesh, task);
  if (!split) return split.error();
  const auto oriented = orientOutwards(split->mesh, task);
  if (!oriented) return oriented.error();
  const auto pairs = findSelfIntersections(oriented->mesh, task);
  if (!pairs) return pairs.error();
  return pairs->size();
}

Result<MeshHealth> wholeHealth(const Mesh& mesh, const Task& task) {
  task.report(0.0, "Looking for self-intersections");
  MeshHealth health = meshHealth(mesh);
  const auto count = countSelfIntersections(mesh, task);
  if (task.stopRequested()) return cancelled();
  if (count) health.self_intersections = *count;
  return health;
}

}  // namespace gyre
