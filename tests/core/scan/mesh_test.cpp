// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/mesh.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

Mesh tetrahedron() {
  Mesh mesh;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
    MeshVertex vertex;
    vertex.position = corner;
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TEST(Mesh, NormalsPointOutOfCounterClockwiseTriangles) {
  Mesh mesh = tetrahedron();
  computeNormals(mesh);
  const Eigen::Vector3d centre(0.25, 0.25, 0.25);
  for (const MeshVertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.normal.norm(), 1.0, 1e-12);
    EXPECT_GT(vertex.normal.dot(vertex.position - centre), 0.0);
  }
}

TEST(Mesh, BoundsOfNothingAreEmpty) {
  EXPECT_TRUE(boundsOf(Mesh{}).empty());
  EXPECT_EQ(boundsOf(Mesh{}).diagonal(), 0.0);
  EXPECT_NEAR(boundsOf(tetrahedron()).diagonal(), std::sqrt(3.0), 1e-12);
}

TEST(PointCloud, SigmaIsTheRootOfTheTrace) {
  Point point;
  point.covariance.diagonal() = Eigen::Vector3d(1, 4, 4);
  EXPECT_DOUBLE_EQ(point.sigmaMm(), 3.0);
}

}  // namespace
}  // namespace gyre
