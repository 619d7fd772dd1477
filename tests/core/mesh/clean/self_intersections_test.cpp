// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/self_intersections.h"

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
