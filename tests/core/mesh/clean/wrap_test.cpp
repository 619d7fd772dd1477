// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "core/mesh/surface_index.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Mesh holedBall() {
  Mesh ball = test::ballMesh(20.0, 64);
  std::erase_if(ball.triangles, [&](const Triangle& triangle) {
    const Eigen::Vector3d& corner = ball.vertices[triangle[0]].position;
    return corner.x() > 0.0 && corner.tail<2>().norm() < 3.0;
  });
  for (MeshVertex& vertex : ball.vertices) {
    vertex.rgb = {20, 40, 60};
    vertex.views = 5;
    vertex.sigma_mm = 0.1F;
  }
  return ball;
}

void expectPrintable(const Mesh& mesh) {
  EXPECT_TRUE(checkSurface(mesh));
  EXPECT_EQ(meshHealth(mesh).genus, 0);
  EXPECT_GT(meshHealth(mesh).volume_mm3, 0.0);
  EXPECT_EQ(*countSelfIntersections(mesh, {}), 0U);
}

TEST(WrapMesh, ClosesABallWithAHole) {
  const Mesh ball = holedBall();
  EXPECT_FALSE(meshHealth(ball).closed);
  const auto wrapped = wrapMesh(ball, {.alpha_mm = 4.5, .offset_mm = 0.4}, {});
  ASSERT_TRUE(wrapped);
  expectPrintable(wrapped->mesh);
  double farthest_mm = 0.0;
  for (const MeshVertex& vertex : wrapped->mesh.vertices) {
    if (vertex.seen == 0) continue;
    farthest_mm = std::max(farthest_mm, std::abs(vertex.position.norm() - 20.0));
    EXPECT_EQ(vertex.rgb[2], 60);
    EXPECT_EQ(vertex.views, 5);
  }
  EXPECT_LT(farthest_mm, 0.45);
  EXPECT_GT(wrapped->on_input_share, 0.9);
  EXPECT_GT(meshHealth(wrapped->mesh).unseen_area_mm2, 5.0);  // the hole has some 28
  EXPECT_LT(meshHealth(wrapped->mesh).unseen_area_mm2, 60.0);
}

TEST(WrapMesh, LiesOnThePointsOfACloud) {
  Mesh points;
  for (const Point& point : test::sphereCloud(3000, 20.0).points) {
    test::addVertex(points, point.position);
  }
  const auto wrapped = wrapMesh(points, {}, {});
  ASSERT_TRUE(wrapped);
  expectPrintable(wrapped->mesh);
  double farthest_mm = 0.0;
  for (const MeshVertex& vertex : wrapped->mesh.vertices) {
    farthest_mm = std::max(farthest_mm, std::abs(vertex.position.norm() - 20.0));
  }
  EXPECT_LT(farthest_mm, wrapped->offset_mm);
  EXPECT_NEAR(meshHealth(wrapped->mesh).volume_mm3, 33510.0, 500.0);
  EXPECT_LT(meshHealth(wrapped->mesh).unseen_area_mm2, 1.0);
}

TEST(WrapMesh, StaysNearTheEdgesOfABox) {
  const Mesh box = test::boxMesh({-5, -5, 0}, {5, 5, 10});
  const auto wrapped = wrapMesh(box, {.alpha_mm = 1.0, .offset_mm = 0.1}, {});
  ASSERT_TRUE(wrapped);
  expectPrintable(wrapped->mesh);
  EXPECT_NEAR(meshHealth(wrapped->mesh).volume_mm3, 1000.0, 10.0);
  const SurfaceIndex index(box);
  for (const MeshVertex& vertex : wrapped->mesh.vertices) {
    EXPECT_LT(index.nearest(vertex.position).distance_mm, 0.11);
  }
}

TEST(WrapMesh, MendsASoupOfTrianglesThatCross) {
  const Mesh boxes =
      test::joined(test::boxMesh({0, 0, 0}, {4, 4, 4}), test::boxMesh({2, 2, 2}, {6, 6, 6}));
  EXPECT_GT(*countSelfIntersections(boxes, {}), 0U);
  const auto wrapped = wrapMesh(boxes, {.alpha_mm = 0.5, .offset_mm = 0.05}, {});
  ASSERT_TRUE(wrapped);
  expectPrintable(wrapped->mesh);
  EXPECT_NEAR(meshHealth(wrapped->mesh).volume_mm3, 64.0 + 64.0 - 8.0,
              2.5);  // a fiftieth of a millimetre all over
}

TEST(WrapMesh, GivesTheSameTwice) {
  const auto first = wrapMesh(holedBall(), {.alpha_mm = 4.5}, {});
  const auto second = wrapMesh(holedBall(), {.alpha_mm = 4.5}, {});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->mesh.triangles, second->mesh.triangles);
}

TEST(WrapMesh, RefusesAndStops) {
  EXPECT_EQ(wrapMesh(Mesh{}, {}, {}).error().code, Error::Code::kTooFew);
  Mesh same;
  for (int i = 0; i < 9; ++i) test::addVertex(same, {1, 2, 3});
  EXPECT_EQ(wrapMesh(same, {}, {}).error().code, Error::Code::kTooFew);
  const Mesh ball = holedBall();
  EXPECT_EQ(wrapMesh(ball, {.alpha_mm = 1e-3}, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(wrapMesh(ball, {.alpha_mm = -1.0}, {}).error().code, Error::Code::kInvalidInput);
  same.vertices[3].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wrapMesh(same, {}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(wrapMesh(ball, {}, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

TEST(WrapMesh, WrapsASingleTriangle) {
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 4.0);
  one.triangles.resize(1);
  const auto wrapped = wrapMesh(one, {.alpha_mm = 1.0, .offset_mm = 0.2}, {});
  ASSERT_TRUE(wrapped);
  expectPrintable(wrapped->mesh);
}

}  // namespace
}  // namespace gyre
