// A small cloud and a small mesh in which every number differs.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// Three points.
inline PointCloud sampleCloud() {
  PointCloud cloud;
  for (int i = 0; i < 3; ++i) {
    Point point;
    point.position = Eigen::Vector3d(0.1 + i, -20.7 * i, 1.0 / 3.0);
    point.normal = Eigen::Vector3d(1 + i, 2, -3).normalized();
    point.rgb = {static_cast<std::uint8_t>(i), 128, 255};
    point.covariance << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 3 + i;
    point.covariance *= 1e-3;
    for (int view = 0; view <= 2 * i; ++view) {
      point.views.push_back(static_cast<std::uint32_t>(100 * i + view));
    }
    cloud.points.push_back(point);
  }
  return cloud;
}

// A tetrahedron whose triangles look outward.
inline Mesh sampleMesh() {
  Mesh mesh;
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1.5, 0, 0), Eigen::Vector3d(0, 2.25, 0),
        Eigen::Vector3d(0, 0, 4096.125)}) {
    MeshVertex vertex;
    vertex.position = corner;
    const auto number = static_cast<std::uint8_t>(mesh.vertices.size());
    vertex.rgb = {number, static_cast<std::uint8_t>(77 * number), 255};
    vertex.sigma_mm = 0.25F * static_cast<float>(number);
    vertex.views = static_cast<std::uint16_t>(300 * number);
    vertex.seen = number == 0 ? 0 : 1;
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  computeNormals(mesh);
  return mesh;
}

}  // namespace gyre
