// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/manifold_selection.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SelectManifold, TakesAllOfAManifoldOnce) {
  std::vector<TriangleCandidate> candidates;
  for (const int level : {0, 1}) {
    for (const Triangle& triangle : test::tetrahedronMesh({0, 0, 0}, 1.0).triangles) {
      candidates.push_back({triangle, level, 1.0});
    }
  }
  EXPECT_EQ(selectManifold(candidates).size(), 4U);
}

TEST(SelectManifold, LeavesOutTheWorstOfThreeAtAnEdge) {
  const auto taken =
      selectManifold({{{0, 1, 2}, 0, 3.0}, {{0, 1, 3}, 0, 1.0}, {{1, 0, 4}, 0, 2.0}});
  EXPECT_EQ(taken, (std::vector<Triangle>{{0, 1, 3}, {1, 0, 4}}));
}

TEST(SelectManifold, LeavesOutATriangleTurnedTheWrongWay) {
  EXPECT_EQ(selectManifold({{{0, 1, 2}, 0, 1.0}, {{0, 1, 3}, 0, 2.0}}).size(), 1U);
  EXPECT_TRUE(selectManifold({}).empty());
}

TEST(SelectManifold, FillsGapsWithHigherLevelsButCoversNothing) {
  // Three triangles surround vertex 0 at level 0; level 1 offers a roof over it and a neighbour.
  const std::vector<TriangleCandidate> candidates = {{{0, 1, 2}, 0, 1.0},
                                                     {{0, 2, 3}, 0, 1.0},
                                                     {{0, 3, 1}, 0, 1.0},
                                                     {{0, 4, 5}, 1, 0.1},
                                                     {{2, 1, 6}, 1, 0.2}};
  const auto taken = selectManifold(candidates);
  ASSERT_EQ(taken.size(), 4U);
  EXPECT_EQ(taken.back(), (Triangle{2, 1, 6}));
}

}  // namespace
}  // namespace gyre
