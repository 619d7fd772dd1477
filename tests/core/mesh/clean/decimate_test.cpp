// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(DecimateMesh, KeepsTheVolumeOfABall) {
  const Mesh ball = test::ballMesh(20.0, 96);  // 9 024 triangles
  const auto decimated = decimateMesh(ball, {.triangles = 1000}, {});
  ASSERT_TRUE(decimated);
  const MeshHealth health = meshHealth(decimated->mesh);
  EXPECT_LE(health.triangles, 1000U);
  EXPECT_GE(health.triangles, 998U);
  EXPECT_EQ(health.genus, 0);
  EXPECT_NEAR(health.volume_mm3 / meshHealth(ball).volume_mm3, 1.0, 0.001);
  EXPECT_LT(decimated->largest_move_mm, 0.25);
  EXPECT_EQ(*countSelfIntersections(decimated->mesh, {}), 0U);
}

TEST(DecimateMesh, KeepsTheHandleOfARing) {
  const auto decimated = decimateMesh(test::ringMesh(20.0, 5.0, 96), {.triangles = 600}, {});
  ASSERT_TRUE(decimated);
  EXPECT_EQ(meshHealth(decimated->mesh).genus, 1);
}

TEST(DecimateMesh, MakesTheFewestTrianglesOfASquareAndKeepsItsRim) {
  const auto decimated = decimateMesh(test::squareMesh(10.0, 2.0), {.triangles = 4}, {});
  ASSERT_TRUE(decimated);
  EXPECT_LE(decimated->mesh.triangles.size(), 4U);
  EXPECT_NEAR(meshHealth(decimated->mesh).area_mm2, 100.0, 1e-6);
}

TEST(DecimateMesh, HoldsTheHeightOfTheBase) {
  const Mesh dome = cropMesh(test::ballMesh(20.0, 96), {.z_min_mm = -7.0}, {})->mesh;
  const auto decimated = decimateMesh(dome, {.triangles = 500, .hold_z_mm = -7.0}, {});
  ASSERT_TRUE(decimated);
  EXPECT_EQ(boundsOf(decimated->mesh).min.z(), -7.0);
  std::size_t on_base = 0;
  for (const MeshVertex& vertex : decimated->mesh.vertices) {
    if (vertex.position.z() == -7.0) ++on_base;
  }
  EXPECT_EQ(meshHealth(decimated->mesh).boundary_edges, on_base);  // all of the rim
}

TEST(DecimateMesh, CarriesAttributes) {
  Mesh ball = test::ballMesh(20.0, 96);
  for (MeshVertex& vertex : ball.vertices) {
    const bool upper = vertex.position.z() > 0.0;
    vertex.rgb = {static_cast<std::uint8_t>(upper ? 250 : 10), 0, 0};
    vertex.sigma_mm = 0.2F;
    vertex.views = 6;
    vertex.seen = upper ? 1 : 0;
  }
  const auto decimated = decimateMesh(ball, {.triangles = 1000}, {});
  ASSERT_TRUE(decimated);
  for (const MeshVertex& vertex : decimated->mesh.vertices) {
    EXPECT_EQ(vertex.views, 6);
    EXPECT_NEAR(vertex.sigma_mm, 0.2, 1e-5);
    if (std::abs(vertex.position.z()) < 2.0) continue;
    EXPECT_EQ(vertex.rgb[0], vertex.position.z() > 0.0 ? 250 : 10);
    EXPECT_EQ(vertex.seen, vertex.position.z() > 0.0 ? 1 : 0);
  }
}

TEST(DecimateMesh, LeavesWhatIsWithinTheBudgetAndGivesTheSameTwice) {
  const Mesh ball = test::ballMesh(20.0, 24);
  EXPECT_EQ(decimateMesh(ball, {}, {})->mesh.triangles, ball.triangles);
  EXPECT_EQ(decimateMesh(ball, {.triangles = 100000}, {})->mesh.triangles, ball.triangles);
  const auto first = decimateMesh(ball, {.triangles = 200}, {});
  const auto second = decimateMesh(ball, {.triangles = 200}, {});
  EXPECT_EQ(first->mesh.triangles, second->mesh.triangles);
}

TEST(DecimateMesh, TakesOneTriangleRefusesAndStops) {
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 1.0);
  one.triangles.resize(1);
  EXPECT_EQ(decimateMesh(one, {.triangles = 1}, {})->mesh.triangles.size(), 1U);
  EXPECT_EQ(decimateMesh(Mesh{}, {.triangles = 1}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(decimateMesh(one, {.triangles = -1}, {}).error().code, Error::Code::kInvalidInput);
  Mesh fan = test::tetrahedronMesh({0, 0, 0}, 1.0);
  test::addVertex(fan, {-1, -1, 0});
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(decimateMesh(fan, {.triangles = 1}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(decimateMesh(test::ballMesh(20.0, 24), {.triangles = 10}, Task(stop.get_token()))
                .error()
                .code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
