// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/blend.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(Blend, StaysInRangeWhereRoundingMakesAWeightNegative) {
  MeshVertex dark;
  MeshVertex bright;
  bright.rgb = {255, 255, 255};
  bright.sigma_mm = 0.5F;
  bright.views = 300;
  const MeshVertex low =
      blend(std::array<WeightedVertex, 2>{{{&dark, 1.0 + 1e-9}, {&bright, -1e-9}}});
  EXPECT_EQ(low.sigma_mm, 0.0F);
  EXPECT_EQ(low.rgb[0], 0);
  EXPECT_EQ(low.views, 0);
  const MeshVertex high = blend(std::array<WeightedVertex, 2>{{{&dark, -0.01}, {&bright, 1.01}}});
  EXPECT_EQ(high.rgb[0], 255);
}

TEST(Blend, IsSeenWhereTheSeenWeighHalf) {
  MeshVertex seen;
  MeshVertex unseen;
  unseen.seen = 0;
  EXPECT_EQ(blend(std::array<WeightedVertex, 2>{{{&seen, 0.5}, {&unseen, 0.5}}}).seen, 1);
  EXPECT_EQ(blend(std::array<WeightedVertex, 2>{{{&seen, 0.4}, {&unseen, 0.6}}}).seen, 0);
}

TEST(CarryAttributes, BlendsBetweenTheCornersOfTheNearestTriangle) {
  Mesh source = test::squareMesh(10.0, 0.0);
  for (MeshVertex& vertex : source.vertices) {
    vertex.views = static_cast<std::uint16_t>(100.0 + 10.0 * vertex.position.x());
  }
  Mesh mesh;
  test::addVertex(mesh, {9.0, 0.0, 0.0});
  test::addVertex(mesh, {2.5, 1.2, 3.0});
  carryAttributes(source, mesh, 1);
  EXPECT_EQ(mesh.vertices[0].views, 0);
  EXPECT_EQ(mesh.vertices[1].views, 125);
  EXPECT_EQ(mesh.vertices[1].position.z(), 3.0);
}

TEST(CarryAttributes, TakesTheNearestPointOfACloud) {
  Mesh points;
  test::addVertex(points, {0, 0, 0});
  test::addVertex(points, {4, 0, 0});
  points.vertices[1].rgb = {7, 8, 9};
  Mesh mesh;
  test::addVertex(mesh, {3, 0, 0});
  carryAttributes(points, mesh);
  EXPECT_EQ(mesh.vertices[0].rgb[2], 9);
}

}  // namespace
}  // namespace gyre
