// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/mesh.h"

#include <Eigen/Geometry>

namespace gyre {

Bounds boundsOf(const Mesh& mesh) {
  Bounds bounds;
  for (const MeshVertex& vertex : mesh.vertices) bounds.include(vertex.position);
  return bounds;
}

void computeNormals(Mesh& mesh) {
  for (MeshVertex& vertex : mesh.vertices) vertex.normal.setZero();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d ab = mesh.vertices[b].position - mesh.vertices[a].position;
    const Eigen::Vector3d ac = mesh.vertices[c].position - mesh.vertices[a].position;
    const Eigen::Vector3d twice_area = ab.cross(ac);
    for (const std::uint32_t corner : {a, b, c}) mesh.vertices[corner].normal += twice_area;
  }
  for (MeshVertex& vertex : mesh.vertices) {
    const double length = vertex.normal.norm();
    if (length > 0.0) vertex.normal /= length;
  }
}

}  // namespace gyre
