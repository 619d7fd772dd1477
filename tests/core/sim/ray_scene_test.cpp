// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ray_scene.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

// A triangle in the plane z = 1, counter-clockwise from above.
Mesh oneTriangle() {
  Mesh mesh;
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(4, 0, 1), Eigen::Vector3d(0, 4, 1)}) {
    mesh.vertices.emplace_back().position = corner;
  }
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(RayScene, TellsWhereItsTrianglesAreMet) {
  const RayScene scene(oneTriangle());
  RayPacket rays;
  rays.origin = {1.0F, 1.0F, 9.0F};
  rays.direction.fill(Eigen::Vector3f(0.0F, 0.0F, -2.0F));
  rays.direction[1] = {5.0F, 0.0F, -1.0F};  // passes it by
  rays.valid = {true, true, false};
  const auto hits = scene.closest(rays);
  EXPECT_EQ(hits[0].triangle, 0U);
  EXPECT_FLOAT_EQ(hits[0].distance, 4.0F);  // in lengths of the direction
  EXPECT_FLOAT_EQ(hits[0].u, 0.25F);
  EXPECT_FLOAT_EQ(hits[0].v, 0.25F);
  EXPECT_EQ(hits[1].triangle, RayHit::kNone);
  EXPECT_EQ(hits[2].triangle, RayHit::kNone);  // not asked for
}

TEST(RayScene, HidesOnlyWhatIsBehindIt) {
  const RayScene scene(oneTriangle());
  const Eigen::Vector3d above(1.0, 1.0, 5.0);
  EXPECT_TRUE(scene.occluded({1.0, 1.0, 0.0}, above, 0.01));
  EXPECT_FALSE(scene.occluded({1.0, 1.0, 2.0}, above, 0.01));
  EXPECT_FALSE(scene.occluded({9.0, 9.0, 0.0}, {9.0, 9.0, 5.0}, 0.01));
  // A point of the surface itself is within the clearance.
  EXPECT_FALSE(scene.occluded({1.0, 1.0, 1.0}, above, 0.01));
}

TEST(RayScene, WithoutTrianglesMeetsNothing) {
  const RayScene scene(Mesh{});
  EXPECT_FALSE(scene.occluded({0.0, 0.0, 0.0}, {0.0, 0.0, 5.0}, 0.0));
}

}  // namespace
}  // namespace gyre
