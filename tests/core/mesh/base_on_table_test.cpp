// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_on_table.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

// A block whose base of two wide triangles lies at height z_mm; its sides are wide too.
Mesh block(double z_mm) {
  Mesh mesh;
  for (const double z : {z_mm, 40.0}) {
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, 0),
                                          Eigen::Vector2d(30, 30), Eigen::Vector2d(0, 30)}) {
      mesh.vertices.emplace_back().position = {corner.x(), corner.y(), z};
    }
  }
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    mesh.triangles.push_back({i, next, next + 4});
    mesh.triangles.push_back({i, next + 4, i + 4});
  }
  return mesh;
}

TEST(RestOnTable, BringsTheBaseDown) {
  Mesh mesh = block(1.0);
  std::vector<double> spacing_mm(mesh.vertices.size(), 1.0);
  restOnTable(mesh, spacing_mm);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_NEAR(health.volume_mm3, 30.0 * 30.0 * 40.0, 1e-9);
  EXPECT_EQ(boundsOf(mesh).min.z(), 0.0);
  EXPECT_EQ(mesh.vertices.size(), spacing_mm.size());
  int unseen = 0;
  for (const MeshVertex& vertex : mesh.vertices) unseen += vertex.seen == 0 ? 1 : 0;
  EXPECT_EQ(unseen, 4);
}

TEST(RestOnTable, LeavesWhatDoesNotStandOnIt) {
  Mesh mesh = block(10.0);
  std::vector<double> spacing_mm(mesh.vertices.size(), 1.0);
  restOnTable(mesh, spacing_mm);
  EXPECT_EQ(mesh.triangles, block(10.0).triangles);
  Mesh measured = block(1.0);
  std::vector<double> wide_mm(measured.vertices.size(), 50.0);
  restOnTable(measured, wide_mm);  // its base was seen
  EXPECT_EQ(measured.triangles, block(1.0).triangles);
}

TEST(RestOnTable, RaisesWhatNoisePutBelow) {
  Mesh mesh = block(-0.2);
  std::vector<double> spacing_mm(mesh.vertices.size(), 1.0);
  restOnTable(mesh, spacing_mm);
  EXPECT_EQ(boundsOf(mesh).min.z(), 0.0);
  EXPECT_NEAR(meshHealth(mesh).volume_mm3, 36000.0, 1e-9);
}

TEST(RestOnTable, OfNothingIsNothing) {
  Mesh mesh;
  std::vector<double> spacing_mm;
  restOnTable(mesh, spacing_mm);
  EXPECT_TRUE(mesh.vertices.empty());
}

}  // namespace
}  // namespace gyre
