// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/split_non_manifold.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/merge_vertices.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Mesh touching(const Mesh& a, const Mesh& b) {
  return mergeVertices(test::joined(a, b), {}, {})->mesh;
}

TEST(SplitNonManifold, SeparatesBoxesThatTouchInAnEdge) {
  const Mesh boxes =
      touching(test::boxMesh({0, 0, 0}, {1, 1, 1}), test::boxMesh({1, 1, 0}, {3, 3, 1}));
  EXPECT_EQ(meshHealth(boxes).non_manifold_edges, 1U);
  const auto split = splitNonManifold(boxes, {});
  ASSERT_TRUE(split);
  const MeshHealth health = meshHealth(split->mesh);
  EXPECT_EQ(split->vertices_added, 2U);
  EXPECT_EQ(split->triangles_removed, 0U);
  EXPECT_TRUE(health.closed);
  EXPECT_EQ(health.components, 2U);
  EXPECT_EQ(health.euler_number, 4);
  EXPECT_NEAR(health.volume_mm3, 5.0, 1e-12);
  EXPECT_TRUE(checkSurface(split->mesh));
}

TEST(SplitNonManifold, SeparatesBoxesThatTouchInAVertex) {
  const Mesh boxes =
      touching(test::boxMesh({0, 0, 0}, {1, 1, 1}), test::boxMesh({1, 1, 1}, {3, 3, 3}));
  EXPECT_EQ(meshHealth(boxes).non_manifold_vertices, 1U);
  const auto split = splitNonManifold(boxes, {});
  ASSERT_TRUE(split);
  EXPECT_EQ(split->vertices_added, 1U);
  EXPECT_TRUE(checkSurface(split->mesh));
}

TEST(SplitNonManifold, TakesAFinOffABox) {
  Mesh box = test::boxMesh({0, 0, 0}, {1, 1, 1});
  const std::uint32_t tip = test::addVertex(box, {-1, -1, 2});
  box.vertices[tip].rgb = {9, 8, 7};
  box.triangles.push_back({0, 4, tip});
  const auto split = splitNonManifold(box, {});
  ASSERT_TRUE(split);
  const MeshHealth health = meshHealth(split->mesh);
  EXPECT_EQ(health.non_manifold_edges, 0U);
  EXPECT_EQ(health.non_manifold_vertices, 0U);
  EXPECT_EQ(health.boundary_edges, 3U);
  EXPECT_EQ(health.components, 2U);
  EXPECT_NEAR(health.volume_mm3, 1.0, 0.5);
  EXPECT_EQ(split->mesh.vertices[tip].rgb[0], 9);
}

TEST(SplitNonManifold, LeavesAProperSurfaceAsItIs) {
  const Mesh ball = test::ballMesh(10.0, 16);
  const auto split = splitNonManifold(ball, {});
  ASSERT_TRUE(split);
  EXPECT_EQ(split->vertices_added, 0U);
  EXPECT_EQ(split->mesh.triangles, ball.triangles);
}

TEST(SplitNonManifold, ThinsACrowdOfTrianglesAtOneEdge) {
  Mesh crowd = test::tetrahedronMesh({0, 0, 0}, 1.0);
  crowd.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 1}, {0, 3, 1}, {0, 1, 1}};
  const auto split = splitNonManifold(crowd, {});
  ASSERT_TRUE(split);
  const MeshHealth health = meshHealth(split->mesh);
  EXPECT_EQ(health.non_manifold_edges, 0U);
  EXPECT_EQ(health.non_manifold_vertices, 0U);
  EXPECT_EQ(split->triangles_removed, 3U);  // two sheets without thickness, crossed
}

TEST(SplitNonManifold, RefusesAnEmptyMeshAndStops) {
  EXPECT_EQ(splitNonManifold(Mesh{}, {}).error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(splitNonManifold(test::ballMesh(1.0, 8), Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
