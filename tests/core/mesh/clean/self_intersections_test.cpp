// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/self_intersections.h"

#include <stop_token>

#include <gtest/gtest.h>

#include "core/mesh/clean/merge_vertices.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SelfIntersections, FindsNoneInProperBodies) {
  EXPECT_EQ(*countSelfIntersections(test::boxMesh({0, 0, 0}, {1, 2, 3}), {}), 0U);
  EXPECT_EQ(*countSelfIntersections(test::ringMesh(20.0, 5.0, 48), {}), 0U);
  EXPECT_EQ(*countSelfIntersections(test::squareMesh(10.0, 0.0), {}), 0U);
}

TEST(SelfIntersections, FindsTheTrianglesThatASpikePierces) {
  Mesh box = test::boxMesh({0, 0, 0}, {4, 4, 4});
  Mesh needle = test::tetrahedronMesh({1.5, 1.0, -1.0}, 0.4);
  needle.vertices[3].position.z() = 2.0;  // through one triangle of the floor
  const auto pairs = findSelfIntersections(test::joined(box, needle), {});
  ASSERT_TRUE(pairs);
  EXPECT_EQ(pairs->size(), 3U);  // with the three sides of the needle
  for (const auto& [a, b] : *pairs) {
    EXPECT_LT(a, 2U);
    EXPECT_GE(b, 12U);
  }
}

TEST(SelfIntersections, CountsBodiesThatTouch) {
  const Mesh boxes =
      test::joined(test::boxMesh({0, 0, 0}, {1, 1, 1}), test::boxMesh({1, 1, 0}, {2, 2, 1}));
  const Mesh touching = mergeVertices(boxes, {}, {})->mesh;
  EXPECT_EQ(findSelfIntersections(touching, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_GT(*countSelfIntersections(touching, {}), 0U);
}

TEST(SelfIntersections, AreTheLastPartOfTheHealth) {
  const auto box = wholeHealth(test::boxMesh({0, 0, 0}, {1, 2, 3}), {});
  ASSERT_TRUE(box);
  EXPECT_EQ(box->self_intersections, 0U);
  EXPECT_EQ(box->genus, 0);
  const auto crossing = wholeHealth(
      test::joined(test::boxMesh({0, 0, 0}, {4, 4, 4}), test::boxMesh({1, 1, -1}, {2, 2, 1})), {});
  ASSERT_TRUE(crossing);
  EXPECT_GT(crossing->self_intersections.value_or(0), 0U);
  // What has nothing to count is examined all the same.
  EXPECT_FALSE(wholeHealth(Mesh{}, {})->self_intersections);
  std::stop_source source;
  source.request_stop();
  const auto stopped = wholeHealth(test::boxMesh({0, 0, 0}, {1, 1, 1}), Task(source.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

TEST(SelfIntersections, TakesOneTriangleRefusesNoneAndStops) {
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 1.0);
  one.triangles.resize(1);
  EXPECT_EQ(*countSelfIntersections(one, {}), 0U);
  EXPECT_EQ(countSelfIntersections(Mesh{}, {}).error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(countSelfIntersections(one, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
