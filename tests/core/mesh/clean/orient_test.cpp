// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/orient.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

void turnSome(Mesh& mesh, double share) {
  Random random(5);
  for (Triangle& triangle : mesh.triangles) {
    if (random.uniform() < share) std::swap(triangle[0], triangle[1]);
  }
}

TEST(OrientOutwards, MakesARingOfConfusedTrianglesPositive) {
  Mesh ring = test::ringMesh(20.0, 5.0, 48);
  const double volume_mm3 = meshHealth(ring).volume_mm3;
  for (const double share : {0.0, 0.5, 1.0}) {
    Mesh confused = ring;
    turnSome(confused, share);
    const auto oriented = orientOutwards(confused, {});
    ASSERT_TRUE(oriented);
    EXPECT_NEAR(meshHealth(oriented->mesh).volume_mm3, volume_mm3, 1e-9);
    EXPECT_TRUE(checkSurface(oriented->mesh));
    EXPECT_GT(oriented->mesh.vertices.front().normal.x(), 0.99);  // at (25, 0, 0)
    EXPECT_NEAR(static_cast<double>(oriented->triangles_turned) /
                    static_cast<double>(ring.triangles.size()),
                share, 0.05);
  }
}

TEST(OrientOutwards, LooksInwardsAroundAHollow) {
  Mesh hollow =
      test::joined(test::boxMesh({0, 0, 0}, {4, 4, 4}), test::boxMesh({1, 1, 1}, {3, 3, 3}));
  hollow = test::joined(hollow, test::boxMesh({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5}));
  turnSome(hollow, 0.4);
  const auto oriented = orientOutwards(hollow, {});
  ASSERT_TRUE(oriented);
  EXPECT_NEAR(meshHealth(oriented->mesh).volume_mm3, 64.0 - 8.0 + 1.0, 1e-9);
}

TEST(OrientOutwards, LeavesAnOpenSheetOnTheSideMostOfItShows) {
  Mesh sheet = test::squareMesh(10.0, 0.0);
  turnSome(sheet, 0.3);
  const auto oriented = orientOutwards(sheet, {});
  ASSERT_TRUE(oriented);
  for (const MeshVertex& vertex : oriented->mesh.vertices) EXPECT_EQ(vertex.normal.z(), 1.0);
}

TEST(OrientOutwards, CutsAMoebiusStrip) {
  Mesh strip;
  constexpr std::uint32_t kStops = 24;
  for (std::uint32_t i = 0; i < kStops; ++i) {
    const double turn_rad = kTurn_rad * i / kStops;
    for (const double side : {-2.0, 2.0}) {
      const double r = 10.0 + side * std::cos(turn_rad / 2);
      test::addVertex(
          strip, {r * std::cos(turn_rad), r * std::sin(turn_rad), side * std::sin(turn_rad / 2)});
    }
  }
  for (std::uint32_t i = 0; i < kStops; ++i) {
    const std::uint32_t a = 2 * i;
    const bool last = i + 1 == kStops;
    const std::uint32_t c = last ? 1 : a + 2;  // the seam joins left to right
    const std::uint32_t d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, d});
    strip.triangles.push_back({a, d, a + 1});
  }
  EXPECT_FALSE(checkSurface(strip));
  const auto oriented = orientOutwards(strip, {});
  ASSERT_TRUE(oriented);
  EXPECT_TRUE(checkSurface(oriented->mesh));
  EXPECT_EQ(oriented->vertices_added, 2U);
  EXPECT_EQ(meshHealth(oriented->mesh).holes, 1U);
}

TEST(OrientOutwards, TakesOneTriangleAndRefusesNone) {
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 1.0);
  one.triangles.resize(1);
  EXPECT_TRUE(orientOutwards(one, {}));
  EXPECT_EQ(orientOutwards(Mesh{}, {}).error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(orientOutwards(one, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
