// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_health.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/components.h"
#include "core/mesh/disjoint_sets.h"
#include "core/mesh/edges.h"
#include "core/mesh/vertex_fans.h"

namespace gyre {
namespace {

// A boundary edge joins the fans at its two ends: what hangs together so is one loop.
std::size_t countLoops(const Mesh& mesh, const std::vector<EdgeUse>& uses, const VertexFans& fans) {
  DisjointSets loops(fans.vertex.size());
  std::vector<std::uint32_t> on_rim;
  forEachEdge(uses, [&](auto begin, auto end) {
    if (end - begin != 1) return;
    const std::uint32_t low = fans.at(mesh.triangles, begin->triangle, begin->low);
    const std::uint32_t high = fans.at(mesh.triangles, begin->triangle, begin->high);
    loops.join(low, high);
    on_rim.push_back(low);
  });
  for (std::uint32_t& fan : on_rim) fan = loops.find(fan);
  std::sort(on_rim.begin(), on_rim.end());
  return static_cast<std::size_t>(std::unique(on_rim.begin(), on_rim.end()) - on_rim.begin());
}

// Counts what edges and the fans around vertices tell.
void examineTopology(const Mesh& mesh, MeshHealth& health) {
  const std::vector<EdgeUse> uses = edgeUses(mesh.triangles);
  const VertexFans fans = findFans(mesh.triangles);
  std::size_t edges = 0;
  forEachEdge(uses, [&](auto begin, auto end) {
    ++edges;
    if (end - begin == 1) ++health.boundary_edges;
    if (end - begin > 2) ++health.non_manifold_edges;
  });
  std::vector<std::uint32_t> fans_of_vertex(mesh.vertices.size());
  for (const std::uint32_t vertex : fans.vertex) ++fans_of_vertex[vertex];
  std::size_t in_use = 0;
  for (const std::uint32_t count : fans_of_vertex) {
    if (count > 0) ++in_use;
    if (count > 1) ++health.non_manifold_vertices;
  }
  health.holes = countLoops(mesh, uses, fans);
  health.closed = !mesh.triangles.empty() && health.boundary_edges == 0;
  health.manifold = !mesh.triangles.empty() && health.non_manifold_edges == 0;
  health.euler_number =
      static_cast<long>(in_use) - static_cast<long>(edges) + static_cast<long>(health.triangles);
  const bool one_surface = health.closed && health.manifold && health.non_manifold_vertices == 0 &&
                           health.components == 1;
  if (one_surface && health.euler_number % 2 == 0) health.genus = (2 - health.euler_number) / 2;
}

}  // namespace

MeshHealth meshHealth(const Mesh& mesh) {
  MeshHealth health;
  health.vertices = mesh.vertices.size();
  health.triangles = mesh.triangles.size();
  const MeshComponents components = findComponents(mesh);
  health.components = components.area_mm2.size();
  for (const double area : components.area_mm2) health.area_mm2 += area;
  examineTopology(mesh, health);
  for (const auto& [a, b, c] : mesh.triangles) {
    const MeshVertex& first = mesh.vertices[a];
    const MeshVertex& second = mesh.vertices[b];
    const MeshVertex& third = mesh.vertices[c];
    health.volume_mm3 += first.position.dot(second.position.cross(third.position)) / 6.0;
    if (first.seen != 0 && second.seen != 0 && third.seen != 0) continue;
    const Eigen::Vector3d to_second = second.position - first.position;
    health.unseen_area_mm2 += 0.5 * to_second.cross(third.position - first.position).norm();
  }
  return health;
}

}  // namespace gyre
