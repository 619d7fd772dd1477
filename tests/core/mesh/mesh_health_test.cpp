// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_health.h"

#include <gtest/gtest.h>

#include "tests/support/solids.h"
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

TEST(MeshHealth, TellsTheGenusOfBallAndRing) {
  const MeshHealth ball = meshHealth(test::ballMesh(10.0, 24));
  EXPECT_EQ(ball.euler_number, 2);
  EXPECT_EQ(ball.genus, 0);
  const MeshHealth ring = meshHealth(test::ringMesh(20.0, 5.0, 48));
  EXPECT_EQ(ring.euler_number, 0);
  EXPECT_EQ(ring.genus, 1);
  const Mesh two = test::joined(test::boxMesh({0, 0, 0}, {1, 1, 1}), test::ballMesh(0.2, 8));
  EXPECT_EQ(meshHealth(two).euler_number, 4);
  EXPECT_FALSE(meshHealth(two).genus.has_value());
}

TEST(MeshHealth, CountsHolesThatMeetInAVertexAsOne) {
  Mesh mesh = test::squareMesh(10.0, 0.0);
  EXPECT_EQ(meshHealth(mesh).holes, 1U);  // its own rim
  std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    return triangle[0] == 3 * 11 + 3 || triangle[0] == 4 * 11 + 4;
  });
  const MeshHealth health = meshHealth(mesh);
  EXPECT_EQ(health.non_manifold_vertices, 1U);
  EXPECT_EQ(health.holes, 2U);  // walking along the triangles, both make one loop
  EXPECT_EQ(meshHealth(test::ballMesh(10.0, 24)).holes, 0U);
}

TEST(MeshHealth, FindsSurfacesThatTouchInOneVertex) {
  Mesh touching =
      test::joined(test::tetrahedronMesh({0, 0, 0}, 1.0), test::tetrahedronMesh({0, 0, 0}, -1.0));
  for (Triangle& triangle : touching.triangles) {
    for (std::uint32_t& corner : triangle) corner = corner == 4 ? 0 : corner;
  }
  const MeshHealth health = meshHealth(touching);
  EXPECT_EQ(health.non_manifold_vertices, 1U);
  EXPECT_EQ(health.non_manifold_edges, 0U);
  EXPECT_FALSE(health.genus.has_value());
}

TEST(MeshHealth, MeasuresWhatNoCameraSaw) {
  Mesh box = test::boxMesh({0, 0, 0}, {2, 3, 5});
  EXPECT_EQ(meshHealth(box).unseen_area_mm2, 0.0);
  for (MeshVertex& vertex : box.vertices) vertex.seen = vertex.position.z() > 0.0 ? 1 : 0;
  EXPECT_NEAR(meshHealth(box).unseen_area_mm2, 2 * 3 + 2 * (2 + 3) * 5, 1e-9);
}

TEST(MeshHealth, IsNeitherClosedNorManifoldWithoutTriangles) {
  const MeshHealth health = meshHealth(Mesh{});
  EXPECT_FALSE(health.closed);
  EXPECT_FALSE(health.manifold);
  EXPECT_EQ(health.components, 0U);
}

}  // namespace
}  // namespace gyre
