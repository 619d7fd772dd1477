// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/solid_cells.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/mesh/mesh_health.h"
#include "core/mesh/vertex_fans.h"

namespace gyre {
namespace {

Tetrahedra randomCells(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  return *delaunay(std::move(points), {});
}

// Finite cells at random: as ragged as a division can be.
SolidCells randomSolid(const Tetrahedra& cells, double share, std::uint64_t seed) {
  Random random(seed);
  SolidCells solid;
  for (std::uint32_t cell = 0; cell < cells.cells(); ++cell) {
    solid.push_back(!cells.isInfinite(cell) && random.uniform() < share ? 1 : 0);
  }
  return solid;
}

Mesh meshOf(const Tetrahedra& cells, const SolidCells& solid) {
  Mesh mesh;
  for (const Eigen::Vector3d& point : cells.points) mesh.vertices.emplace_back().position = point;
  mesh.triangles = wallOf(cells, solid);
  return mesh;
}

TEST(WallOf, LooksOutward) {
  const Tetrahedra cells = randomCells(200, 1);
  SolidCells solid = randomSolid(cells, 1.1, 1);
  const MeshHealth health = meshHealth(meshOf(cells, solid));
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_GT(health.volume_mm3, 0.7);
  EXPECT_LT(health.volume_mm3, 1.0);
}

TEST(FillCavities, FillsWhatCannotBeReached) {
  const Tetrahedra cells = randomCells(300, 2);
  SolidCells solid = randomSolid(cells, 1.1, 1);
  const SolidCells full = solid;
  for (std::uint32_t cell = 0; cell < cells.cells(); ++cell) {
    bool deep = solid[cell] != 0;
    for (const std::uint32_t next : cells.neighbours[cell]) deep = deep && !cells.isInfinite(next);
    if (!deep) continue;
    solid[cell] = 0;
    break;
  }
  ASSERT_NE(solid, full);
  fillCavities(cells, solid);
  EXPECT_EQ(solid, full);
}

TEST(FreeCrumbs, KeepsTheLargestPieceAlways) {
  const Tetrahedra cells = randomCells(400, 3);
  SolidCells solid = randomSolid(cells, 0.25, 5);
  freeCrumbs(cells, 1.0, solid);
  const Mesh mesh = meshOf(cells, solid);
  EXPECT_FALSE(mesh.triangles.empty());
  SolidCells all = randomSolid(cells, 0.25, 5);
  const SolidCells before = all;
  freeCrumbs(cells, 0.0, all);
  EXPECT_EQ(all, before);
}

TEST(MakeManifold, LeavesEveryEdgeTwoTrianglesAndEveryVertexOneFan) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Tetrahedra cells = randomCells(300, seed);
    SolidCells solid = randomSolid(cells, 0.1 * static_cast<double>(1 + seed % 8), seed);
    EXPECT_EQ(makeManifold(cells, solid), 0U) << "seed " << seed;
    for (std::uint32_t cell = 0; cell < cells.cells(); ++cell) {
      ASSERT_FALSE(cells.isInfinite(cell) && solid[cell] != 0);
    }
    const MeshHealth health = meshHealth(meshOf(cells, solid));
    if (health.triangles == 0) continue;
    EXPECT_TRUE(health.closed) << "seed " << seed;
    EXPECT_TRUE(health.manifold) << "seed " << seed;
    EXPECT_EQ(health.non_manifold_vertices, 0U) << "seed " << seed;
  }
}

TEST(MakeManifold, ChangesNothingThatIsOne) {
  const Tetrahedra cells = randomCells(300, 4);
  SolidCells solid = randomSolid(cells, 1.1, 1);
  const SolidCells before = solid;
  EXPECT_EQ(makeManifold(cells, solid), 0U);
  EXPECT_EQ(solid, before);
}

}  // namespace
}  // namespace gyre
