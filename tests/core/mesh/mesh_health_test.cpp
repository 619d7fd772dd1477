// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_health.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(MeshHealth, ExaminesATetrahedron) {
  const MeshHealth health = meshHealth(test::tetrahedronMesh({10, 20, 30}, 6.0));
  EXPECT_EQ(health.vertices, 4U);
  EXPECT_EQ(health.triangles, 4U);
  EXPECT_EQ(health.components, 1U);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_NEAR(health.volume_mm3, 36.0, 1e-9);
  EXPECT_NEAR(health.area_mm2, 3 * 18.0 + 18.0 * std::sqrt(3.0), 1e-9);
}

TEST(MeshHealth, CountsTheRimOfAnOpenMesh) {
  const MeshHealth health = meshHealth(test::squareMesh(10.0, 1.0));
  EXPECT_EQ(health.boundary_edges, 40U);
  EXPECT_FALSE(health.closed);
  EXPECT_TRUE(health.manifold);
}

TEST(MeshHealth, FindsThreeTrianglesAtOneEdge) {
  Mesh fan = test::tetrahedronMesh({0, 0, 0}, 1.0);
  fan.vertices.push_back({});
  fan.vertices.back().position = {-1, -1, 0};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const MeshHealth health = meshHealth(fan);
  EXPECT_EQ(health.non_manifold_edges, 1U);
  EXPECT_FALSE(health.manifold);
  EXPECT_EQ(health.components, 1U);
}

TEST(MeshHealth, IsNeitherClosedNorManifoldWithoutTriangles) {
  const MeshHealth health = meshHealth(Mesh{});
  EXPECT_FALSE(health.closed);
  EXPECT_FALSE(health.manifold);
  EXPECT_EQ(health.components, 0U);
}

}  // namespace
}  // namespace gyre
