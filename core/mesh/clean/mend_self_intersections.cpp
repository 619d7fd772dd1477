// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/mend_self_intersections.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/clean/vertex_origins.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

namespace repair = CGAL::Polygon_mesh_processing::experimental;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Ends the repair between two places once a stop is asked for.
struct StopsOnRequest : repair::Remove_self_intersection_default_visitor<SurfaceMesh> {
  const Task* task = nullptr;
  bool stop() const { return task->stopRequested(); }
};

Triangle ascending(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

// Gives the vertices of `mended` back what they were told to be before the repair. Surface that was
// not there before counts as unseen, also where it spans vertices that were.
void takeAttributes(const Mesh& before, Mesh& mended) {
  const VertexOrigins origins(before);
  std::vector<Eigen::Vector3d> places;
  places.reserve(before.vertices.size());
  for (const MeshVertex& vertex : before.vertices) places.push_back(vertex.position);
  const KdTree tree(std::move(places));
  std::vector<std::uint32_t> origin_of;
  for (MeshVertex& vertex : mended.vertices) {
    const std::uint32_t origin = origin_of.emplace_back(origins.at(vertex.position));
    if (origin != VertexOrigins::kNone) {
      vertex = before.vertices[origin];
    } else {
      const std::uint32_t nearest = tree.nearest(vertex.position, 1).front().index;
      vertex = unseenVertex(vertex.position, before.vertices[nearest].rgb);
    }
  }
  std::set<Triangle> known;
  for (const Triangle& triangle : before.triangles) known.insert(ascending(triangle));
  std::vector<std::uint32_t> fresh;
  for (std::uint32_t t = 0; t < mended.triangles.size(); ++t) {
    Triangle triangle = mended.triangles[t];
    for (std::uint32_t& corner : triangle) corner = origin_of[corner];
    if (!known.contains(ascending(triangle))) fresh.push_back(t);
  }
  divideSeenTriangles(mended, fresh);
}

bool sameShape(const Mesh& a, const Mesh& b) {
  const MeshHealth before = meshHealth(a);
  const MeshHealth after = meshHealth(b);
  return before.closed == after.closed && before.genus == after.genus &&
         before.components == after.components && before.holes == after.holes;
}

}  // namespace

Result<MendedMesh> mendSelfIntersections(const Mesh& mesh, const Task& task) {
  task.report(0.0, "Looking for self-intersections");
  const auto pairs = findSelfIntersections(mesh, task);
  if (!pairs) return pairs.error();
  MendedMesh mended{mesh, pairs->size(), pairs->size()};
  if (pairs->empty()) return mended;
  task.report(0.3, "Mending self-intersections");
  return guarded("The mending of self-intersections", [&]() -> Result<MendedMesh> {
    SurfaceMesh surface = surfaceMeshOf<SurfaceMesh>(mesh);
    StopsOnRequest visitor;
    visitor.task = &task;
    repair::remove_self_intersections(surface,
                                      CGAL::parameters::preserve_genus(true).visitor(visitor));
    if (task.stopRequested()) return cancelled();
    Mesh attempt = meshOf(surface);
    if (!checkSurface(attempt)) return std::move(mended);
    takeAttributes(mesh, attempt);
    const auto left = findSelfIntersections(attempt, task.part(0.8, 1.0));
    if (!left) return left.error();
    if (left->size() >= pairs->size() || !sameShape(mesh, attempt)) return std::move(mended);
    computeNormals(attempt);
    mended.mesh = std::move(attempt);
    mended.pairs_left = left->size();
    return std::move(mended);
  });
}

}  // namespace gyre
