// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/unseen_facets.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

Mesh tetrahedron(double side_mm) {
  Mesh mesh;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
    mesh.vertices.emplace_back().position = side_mm * corner;
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TEST(MarkWideFacets, GivesWideOnesAnUnseenMiddle) {
  Mesh mesh = tetrahedron(10.0);
  markWideFacets(mesh, std::vector<double>{1, 1, 1, 1});
  ASSERT_EQ(mesh.vertices.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(mesh.vertices[i].seen, i < 4 ? 1 : 0);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_NEAR(health.volume_mm3, 1000.0 / 6.0, 1e-9);
  EXPECT_NEAR(health.unseen_area_mm2, health.area_mm2, 1e-9);
}

TEST(MarkWideFacets, LeavesWhatIsAsDenseAsItsPoints) {
  Mesh mesh = tetrahedron(10.0);
  markWideFacets(mesh, std::vector<double>{5, 5, 5, 5});
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

}  // namespace
}  // namespace gyre
