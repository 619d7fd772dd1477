// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/fill_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/components.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// A ball of 20 mm with a round hole of so many millimetres on the x axis.
Mesh holedBall(double hole_mm) {
  Mesh ball = test::ballMesh(20.0, 96);
  std::erase_if(ball.triangles, [&](const Triangle& triangle) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t corner : triangle) sum += ball.vertices[corner].position;
    return sum.x() > 0.0 && (sum / 3.0).tail<2>().norm() < hole_mm / 2.0;
  });
  removeUnusedVertices(ball);
  for (MeshVertex& vertex : ball.vertices) {
    vertex.rgb = {200, 100, 50};
    vertex.sigma_mm = 0.1F;
    vertex.views = 7;
  }
  return ball;
}

TEST(FillHoles, ClosesABallAsRoundAsItWas) {
  const Mesh holed = holedBall(10.0);
  const auto filled = fillHoles(holed, {.max_width_mm = 20.0}, {});
  ASSERT_TRUE(filled);
  const MeshHealth health = meshHealth(filled->mesh);
  EXPECT_EQ(filled->holes_filled, 1U);
  EXPECT_EQ(health.genus, 0);
  EXPECT_EQ(*countSelfIntersections(filled->mesh, {}), 0U);
  // A flat lid would lose 25 mm^3: the cap is 0.64 mm high.
  const double whole_mm3 = meshHealth(test::ballMesh(20.0, 96)).volume_mm3;
  EXPECT_NEAR(health.volume_mm3, whole_mm3, 8.0);
  double farthest_mm = 0.0;
  for (const MeshVertex& vertex : filled->mesh.vertices) {
    farthest_mm = std::max(farthest_mm, std::abs(vertex.position.norm() - 20.0));
  }
  EXPECT_LT(farthest_mm, 0.2);
}

TEST(FillHoles, MarksWhatItMadeAsUnseen) {
  const Mesh holed = holedBall(10.0);
  const auto filled = fillHoles(holed, {.max_width_mm = 20.0}, {});
  ASSERT_TRUE(filled);
  for (std::size_t v = 0; v < filled->mesh.vertices.size(); ++v) {
    const MeshVertex& vertex = filled->mesh.vertices[v];
    const bool was_there = v < holed.vertices.size();
    EXPECT_EQ(vertex.seen, was_there ? 1 : 0);
    EXPECT_EQ(vertex.views, was_there ? 7 : 0);
    EXPECT_EQ(vertex.sigma_mm, was_there ? 0.1F : 0.0F);
    EXPECT_EQ(vertex.rgb[1], 100);
    if (was_there) {
      EXPECT_EQ(vertex.position, holed.vertices[v].position);
    }
  }
  EXPECT_NEAR(meshHealth(filled->mesh).unseen_area_mm2, filled->filled_mm2, 1e-6);
  EXPECT_GT(filled->filled_mm2, 60.0);
  EXPECT_LT(filled->filled_mm2, 110.0);
}

TEST(FillHoles, MarksAHoleOfOneTriangleToo) {
  Mesh box = test::boxMesh({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  const auto filled = fillHoles(box, {.max_width_mm = 5.0}, {});
  ASSERT_TRUE(filled);
  EXPECT_TRUE(meshHealth(filled->mesh).closed);
  EXPECT_NEAR(meshHealth(filled->mesh).volume_mm3, 1.0, 1e-9);
  EXPECT_NEAR(meshHealth(filled->mesh).unseen_area_mm2, 0.5, 1e-9);
}

TEST(FillHoles, LeavesWideAndSparedHolesOpen) {
  const Mesh holed = holedBall(10.0);
  EXPECT_EQ(fillHoles(holed, {.max_width_mm = 8.0}, {})->holes_filled, 0U);
  EXPECT_EQ(fillHoles(holed, {}, {})->holes_left, 1U);
  const auto spared = fillHoles(holed, {.max_width_mm = 20.0, .spare_below_mm = 8.0}, {});
  ASSERT_TRUE(spared);
  EXPECT_EQ(spared->holes_left, 1U);
  EXPECT_FALSE(meshHealth(spared->mesh).closed);
}

TEST(FillHoles, GivesTheSameTwice) {
  const Mesh holed = holedBall(14.0);
  const auto first = fillHoles(holed, {.max_width_mm = 30.0}, {});
  const auto second = fillHoles(holed, {.max_width_mm = 30.0}, {});
  ASSERT_TRUE(first && second);
  ASSERT_EQ(first->mesh.triangles, second->mesh.triangles);
  for (std::size_t v = 0; v < first->mesh.vertices.size(); ++v) {
    EXPECT_EQ(first->mesh.vertices[v].position, second->mesh.vertices[v].position);
  }
}

TEST(FillHoles, RefusesAndStops) {
  const Mesh holed = holedBall(10.0);
  EXPECT_EQ(fillHoles(Mesh{}, {}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(fillHoles(holed, {.max_width_mm = -1.0}, {}).error().code, Error::Code::kInvalidInput);
  Mesh broken = holed;
  broken.vertices[9].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fillHoles(broken, {}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(fillHoles(holed, {.max_width_mm = 20.0}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
