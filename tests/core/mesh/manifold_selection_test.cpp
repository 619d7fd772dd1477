// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/manifold_selection.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SelectManifold, TakesAllOfAManifold) {
  std::vector<TriangleCandidate> candidates;
  for (const Triangle& triangle : test::tetrahedronMesh({0, 0, 0}, 1.0).triangles) {
    candidates.push_back({triangle, 1.0});
  }
  EXPECT_EQ(selectManifold(candidates).size(), 4U);
}

TEST(SelectManifold, LeavesOutTheWorstOfThreeAtAnEdge) {
  const auto taken = selectManifold({{{0, 1, 2}, 3.0}, {{0, 1, 3}, 1.0}, {{1, 0, 4}, 2.0}});
  EXPECT_EQ(taken, (std::vector<Triangle>{{0, 1, 3}, {1, 0, 4}}));
}

TEST(SelectManifold, LeavesOutATriangleTurnedTheWrongWay) {
  EXPECT_EQ(selectManifold({{{0, 1, 2}, 1.0}, {{0, 1, 3}, 2.0}}).size(), 1U);
  EXPECT_TRUE(selectManifold({}).empty());
}

}  // namespace
}  // namespace gyre
