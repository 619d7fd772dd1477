// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/small_holes.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// A square of 10 mm with a hole of 1 by 1 mm and one of 3 by 1 mm in it.
Mesh perforated() {
  Mesh mesh = test::squareMesh(10.0, 0.0);
  std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    const std::size_t cell_corner = triangle[0];
    const std::size_t column = cell_corner % 11;
    const std::size_t row = cell_corner / 11;
    return (row == 2 && column == 2) || (row == 6 && column >= 4 && column <= 6);
  });
  return mesh;
}

TEST(CloseSmallHoles, ClosesHolesAndLeavesTheRim) {
  Mesh mesh = perforated();
  EXPECT_EQ(closeSmallHoles(mesh, {24, 9.0}), 2U);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_EQ(health.boundary_edges, 40U);
  EXPECT_TRUE(health.manifold);
  EXPECT_NEAR(health.area_mm2, 100.0, 1e-9);
  computeNormals(mesh);
  for (const MeshVertex& vertex : mesh.vertices) EXPECT_NEAR(vertex.normal.z(), 1.0, 1e-9);
}

TEST(CloseSmallHoles, LeavesWideHolesOpen) {
  Mesh mesh = perforated();
  EXPECT_EQ(closeSmallHoles(mesh, {24, 5.0}), 1U);
  EXPECT_EQ(meshHealth(mesh).boundary_edges, 48U);
  EXPECT_EQ(closeSmallHoles(mesh, {7, 100.0}), 0U);
}

TEST(CloseSmallHoles, ClosesHolesThatMeetInAVertex) {
  Mesh mesh = test::squareMesh(10.0, 0.0);
  std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    return triangle[0] == 3 * 11 + 3 || triangle[0] == 4 * 11 + 4;
  });
  EXPECT_EQ(closeSmallHoles(mesh, {24, 5.0}), 2U);
  EXPECT_EQ(meshHealth(mesh).boundary_edges, 40U);
}

TEST(CloseSmallHoles, DoesNotCoverATriangleFromBehind) {
  Mesh triangle = test::tetrahedronMesh({0, 0, 0}, 1.0);
  triangle.triangles = {{0, 1, 2}, {0, 2, 3}};  // the rim's other diagonal is free, this one is not
  EXPECT_EQ(closeSmallHoles(triangle, {24, 100.0}), 1U);
  EXPECT_TRUE(meshHealth(triangle).closed);
  EXPECT_TRUE(meshHealth(triangle).manifold);
  Mesh empty;
  EXPECT_EQ(closeSmallHoles(empty, {24, 100.0}), 0U);
}

}  // namespace
}  // namespace gyre
