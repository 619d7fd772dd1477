// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_on_table.h"

#include <array>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/mesh/clean/self_intersections.h"
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

// A block on four cells, its base at z = 1; under two of them, across from each other, a hollow
// reaches up to z = 20, so the flat ones meet in the middle alone.
Mesh chequeredBlock() {
  Mesh mesh;
  for (const double z : {1.0, 40.0}) {
    for (int i = 0; i < 9; ++i) {
      mesh.vertices.emplace_back().position = {15.0 * (i % 3), 15.0 * (i / 3), z};
    }
  }
  const auto addSquare = [&](const std::array<std::uint32_t, 4>& corners) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh.triangles.push_back({corners[0], corners[2], corners[3]});
  };
  for (const std::uint32_t i : {0U, 1U, 3U, 4U}) {
    addSquare({i + 9, i + 10, i + 13, i + 12});
    const std::array<std::uint32_t, 4> below = {i, i + 3, i + 4, i + 1};
    if (i == 0 || i == 4) {
      addSquare(below);
      continue;
    }
    const auto apex = static_cast<std::uint32_t>(mesh.vertices.size());
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t corner : below) middle += 0.25 * mesh.vertices[corner].position;
    mesh.vertices.emplace_back().position = {middle.x(), middle.y(), 20.0};
    for (std::size_t k = 0; k < 4; ++k) {
      mesh.triangles.push_back({below[k], below[(k + 1) % 4], apex});
    }
  }
  const std::array<std::uint32_t, 8> around = {0, 1, 2, 5, 8, 7, 6, 3};
  for (std::size_t k = 0; k < 8; ++k) {
    const std::uint32_t next = around[(k + 1) % 8];
    addSquare({around[k], next, next + 9, around[k] + 9});
  }
  return mesh;
}

TEST(RestOnTable, GivesPartsThatMeetInAVertexFeetOfTheirOwn) {
  Mesh mesh = chequeredBlock();
  std::vector<double> spacing_mm(mesh.vertices.size(), 1.0);
  restOnTable(mesh, spacing_mm);
  const auto health = wholeHealth(mesh, Task{});
  ASSERT_TRUE(health) << health.error().sentence();
  EXPECT_TRUE(health->closed);
  EXPECT_TRUE(health->manifold);
  EXPECT_EQ(health->self_intersections, 0U);
  const double hollow_mm3 = 15.0 * 15.0 * 19.0 / 3.0;
  const double lowered_mm3 = 15.0 * 15.0 * 1.0;
  EXPECT_NEAR(health->volume_mm3, 900.0 * 39.0 + 2.0 * lowered_mm3 - 2.0 * hollow_mm3, 20.0);
}

// A vertex that lies in the table already is its own foot: no wall of no height stands on it.
TEST(RestOnTable, LeavesVerticesInTheTableThere) {
  Mesh mesh = block(1.0);
  mesh.vertices[0].position.z() = 0.0;
  std::vector<double> spacing_mm(mesh.vertices.size(), 1.0);
  restOnTable(mesh, spacing_mm);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(mesh.vertices.size(), 11U);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& at = mesh.vertices[a].position;
    EXPECT_GT((mesh.vertices[b].position - at).cross(mesh.vertices[c].position - at).norm(), 1.0);
  }
  EXPECT_NEAR(health.volume_mm3, 36000.0, 1e-9);
}

TEST(RestOnTable, OfNothingIsNothing) {
  Mesh mesh;
  std::vector<double> spacing_mm;
  restOnTable(mesh, spacing_mm);
  EXPECT_TRUE(mesh.vertices.empty());
}

}  // namespace
}  // namespace gyre
