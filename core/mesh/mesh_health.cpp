// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_health.h"

#include <Eigen/Geometry>

#include "core/mesh/components.h"
#include "core/mesh/edges.h"

namespace gyre {

MeshHealth meshHealth(const Mesh& mesh) {
  MeshHealth health;
  health.vertices = mesh.vertices.size();
  health.triangles = mesh.triangles.size();
  const MeshComponents components = findComponents(mesh);
  health.components = components.area_mm2.size();
  for (const double area : components.area_mm2) health.area_mm2 += area;
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin == 1) ++health.boundary_edges;
    if (end - begin > 2) ++health.non_manifold_edges;
  });
  health.closed = !mesh.triangles.empty() && health.boundary_edges == 0;
  health.manifold = !mesh.triangles.empty() && health.non_manifold_edges == 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    health.volume_mm3 +=
        mesh.vertices[a].position.dot(mesh.vertices[b].position.cross(mesh.vertices[c].position)) /
        6.0;
  }
  return health;
}

}  // namespace gyre
