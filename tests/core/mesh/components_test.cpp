// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/components.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Mesh largeAndSmall() {
  Mesh mesh = test::joined(test::tetrahedronMesh({50, 0, 0}, 1.0), test::squareMesh(10.0, 0.0));
  mesh.vertices.push_back({});  // used by nothing
  return mesh;
}

TEST(FindComponents, NumbersPiecesAndMeasuresThem) {
  const MeshComponents found = findComponents(largeAndSmall());
  ASSERT_EQ(found.area_mm2.size(), 2U);
  EXPECT_EQ(found.of_triangle.front(), 0U);
  EXPECT_EQ(found.of_triangle.back(), 1U);
  EXPECT_NEAR(found.area_mm2[0], 1.5 + 0.5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(found.area_mm2[1], 100.0, 1e-9);
}

TEST(FindComponents, DoesNotJoinPiecesThatShareOneVertex) {
  Mesh bow_tie = test::tetrahedronMesh({0, 0, 0}, 1.0);
  bow_tie.vertices.push_back({});
  bow_tie.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(findComponents(bow_tie).area_mm2.size(), 2U);
}

TEST(RemoveSmallComponents, KeepsTheLargeOne) {
  Mesh mesh = largeAndSmall();
  removeSmallComponents(mesh, 0.1);
  EXPECT_EQ(mesh.vertices.size(), 121U);
  EXPECT_EQ(mesh.triangles.size(), 200U);
  EXPECT_NEAR(findComponents(mesh).area_mm2.at(0), 100.0, 1e-9);
}

TEST(RemoveSmallComponents, KeepsAllWithoutAMinimum) {
  Mesh mesh = largeAndSmall();
  removeSmallComponents(mesh, 0.0);
  EXPECT_EQ(mesh.triangles.size(), 204U);
  EXPECT_EQ(mesh.vertices.size(), 125U);
}

TEST(RemoveSmallComponents, LeavesAnEmptyMeshAlone) {
  Mesh empty;
  removeSmallComponents(empty, 0.5);
  EXPECT_TRUE(empty.triangles.empty());
}

}  // namespace
}  // namespace gyre
