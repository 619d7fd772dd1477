// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/marching_tetrahedra.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

TEST(MarchingTetrahedra, MakesABallOfTheRightSizeAndSide) {
  const auto ball = [](const Eigen::Vector3d& place) { return place.norm() - 10.0; };
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-10.0), Eigen::Vector3d::Constant(10.0));
  const Mesh mesh = marchingTetrahedra(sampleDistance(ball, box, 0.5));
  const MeshHealth health = meshHealth(mesh);
  EXPECT_EQ(health.genus, 0);
  // Chords lie within the arc: less by about 0.1 mm at most.
  EXPECT_NEAR(health.volume_mm3, 4.0 / 3.0 * kPi * 1000.0, 0.01 * 4.0 / 3.0 * kPi * 1000.0);
  for (const MeshVertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.position.norm(), 10.0, 0.02);
    EXPECT_GT(vertex.normal.dot(vertex.position.normalized()), 0.5);  // needles are crooked
  }
}

TEST(MarchingTetrahedra, KeepsTheHoleOfARing) {
  const auto ring = [](const Eigen::Vector3d& p) {
    return std::hypot(p.head<2>().norm() - 10.0, p.z()) - 3.0;
  };
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-13, -13, -3), Eigen::Vector3d(13, 13, 3));
  EXPECT_EQ(meshHealth(marchingTetrahedra(sampleDistance(ring, box, 0.7))).genus, 1);
}

// Values without any sense, where surfaces touch in every way: still every edge has two triangles
// that agree on the outside, and no triangle is without area.
TEST(MarchingTetrahedra, IsClosedAndManifoldWhateverTheValues) {
  Random random(7);
  DistanceLattice lattice;
  lattice.size = {12, 12, 12};
  lattice.values.resize(12 * 12 * 12, 1.0F);
  for (int z = 1; z < 11; ++z) {
    for (int y = 1; y < 11; ++y) {
      for (int x = 1; x < 11; ++x) {
        const double value = std::floor(random.uniform(-2.0, 2.0));  // zeros too
        lattice.values[lattice.index({x, y, z})] = static_cast<float>(value);
      }
    }
  }
  const Mesh mesh = marchingTetrahedra(lattice);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_GT(health.triangles, 2000U);
  EXPECT_TRUE(health.closed);
  EXPECT_EQ(health.non_manifold_edges, 0U);
  EXPECT_EQ(health.non_manifold_vertices, 0U);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& first = mesh.vertices[a].position;
    EXPECT_GT((mesh.vertices[b].position - first).cross(mesh.vertices[c].position - first).norm(),
              1e-6);
  }
}

TEST(MarchingTetrahedra, OfNothingSolidIsNothing) {
  const auto nowhere = [](const Eigen::Vector3d&) { return 5.0; };
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  EXPECT_TRUE(marchingTetrahedra(sampleDistance(nowhere, box, 0.3)).triangles.empty());
}

}  // namespace
}  // namespace gyre
