// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/base_cap.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "core/mesh/surface_index.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(RemeshEvenly, MakesEdgesOfABallEvenOnItsSurface) {
  const Mesh ball = test::ballMesh(20.0, 96);
  const auto remeshed = remeshEvenly(ball, {.edge_mm = 1.5}, {});
  ASSERT_TRUE(remeshed);
  EXPECT_NEAR(remeshed->mean_edge_mm, 1.5, 0.15);
  EXPECT_EQ(meshHealth(remeshed->mesh).genus, 0);
  EXPECT_NEAR(meshHealth(remeshed->mesh).volume_mm3 / meshHealth(ball).volume_mm3, 1.0, 0.003);
  const SurfaceIndex index(ball);
  double farthest_mm = 0.0;
  for (const MeshVertex& vertex : remeshed->mesh.vertices) {
    farthest_mm = std::max(farthest_mm, index.nearest(vertex.position).distance_mm);
  }
  EXPECT_LT(farthest_mm, 1e-9);
}

TEST(RemeshEvenly, KeepsTheEdgesOfABox) {
  const Mesh box = test::boxMesh({-5, -5, 0}, {5, 5, 10});
  const auto remeshed = remeshEvenly(box, {.edge_mm = 1.0}, {});
  ASSERT_TRUE(remeshed);
  const MeshHealth health = meshHealth(remeshed->mesh);
  EXPECT_GT(health.triangles, 1000U);
  EXPECT_EQ(health.genus, 0);
  EXPECT_NEAR(health.volume_mm3, 1000.0, 1e-6);
  EXPECT_NEAR(health.area_mm2, 600.0, 1e-6);
  EXPECT_EQ(*countSelfIntersections(remeshed->mesh, {}), 0U);
}

TEST(RemeshEvenly, KeepsTheRimOfASheet) {
  const auto remeshed = remeshEvenly(test::squareMesh(10.0, 3.0), {.edge_mm = 0.7}, {});
  ASSERT_TRUE(remeshed);
  EXPECT_NEAR(meshHealth(remeshed->mesh).area_mm2, 100.0, 1e-6);
  EXPECT_EQ(meshHealth(remeshed->mesh).holes, 1U);
}

TEST(RemeshEvenly, CarriesAttributes) {
  Mesh box = remeshEvenly(test::boxMesh({-5, -5, 0}, {5, 5, 10}), {.edge_mm = 1.0}, {})->mesh;
  for (MeshVertex& vertex : box.vertices) {
    vertex.rgb = {static_cast<std::uint8_t>(100.0 + 10.0 * vertex.position.z()), 0, 0};
    vertex.views = 5;
    vertex.seen = vertex.position.z() > 5.0 ? 1 : 0;
  }
  const auto remeshed = remeshEvenly(box, {.edge_mm = 2.0}, {});
  ASSERT_TRUE(remeshed);
  for (const MeshVertex& vertex : remeshed->mesh.vertices) {
    if (std::abs(vertex.position.z() - 5.0) < 1.5) continue;
    EXPECT_NEAR(vertex.rgb[0], 100.0 + 10.0 * vertex.position.z(), 1.5);
    EXPECT_EQ(vertex.seen, vertex.position.z() > 5.0 ? 1 : 0);
    EXPECT_EQ(vertex.views, 5);
  }
  EXPECT_NEAR(meshHealth(remeshed->mesh).unseen_area_mm2, meshHealth(box).unseen_area_mm2, 40.0);
}

TEST(RemeshEvenly, LeavesAFlatBaseUnseen) {
  Mesh box = test::boxMesh({-5, -5, 0}, {5, 5, 10});
  box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
  const Mesh capped = capBase(box, {}, {})->mesh;
  EXPECT_NEAR(meshHealth(capped).unseen_area_mm2, 100.0, 1e-9);
  for (const double edge_mm : {2.0, 9.0}) {
    const auto remeshed = remeshEvenly(capped, {.edge_mm = edge_mm}, {});
    ASSERT_TRUE(remeshed);
    EXPECT_NEAR(meshHealth(remeshed->mesh).unseen_area_mm2, 100.0, 1e-6) << edge_mm;
  }
}

TEST(RemeshEvenly, RefusesAndStops) {
  const Mesh box = test::boxMesh({-5, -5, 0}, {5, 5, 10});
  EXPECT_EQ(remeshEvenly(box, {}, {})->mesh.triangles, box.triangles);
  EXPECT_EQ(remeshEvenly(box, {.edge_mm = 0.001}, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(remeshEvenly(box, {.edge_mm = -1.0}, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(remeshEvenly(Mesh{}, {.edge_mm = 1.0}, {}).error().code, Error::Code::kTooFew);
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 1.0);
  one.triangles.resize(1);
  EXPECT_NEAR(meshHealth(remeshEvenly(one, {.edge_mm = 0.2}, {})->mesh).area_mm2, 0.5, 1e-9);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(remeshEvenly(box, {.edge_mm = 1.0}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
