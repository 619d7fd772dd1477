// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/base_cap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// A tube of 24 walls, 10 mm in radius, that is closed by a tip above and open below; its lower
// rim runs at the height given for each wall.
template <class Height>
Mesh openTent(const Height& rim_height_mm) {
  Mesh mesh;
  constexpr std::uint32_t kWalls = 24;
  const std::uint32_t tip = test::addVertex(mesh, {0, 0, 30});
  for (std::uint32_t i = 0; i < kWalls; ++i) {
    const double turn_rad = kTurn_rad * i / kWalls;
    const Eigen::Vector2d out(10.0 * std::cos(turn_rad), 10.0 * std::sin(turn_rad));
    test::addVertex(mesh, {out.x(), out.y(), rim_height_mm(i)});
    test::addVertex(mesh, {out.x(), out.y(), 20.0});
  }
  for (std::uint32_t i = 0; i < kWalls; ++i) {
    const std::uint32_t a = 1 + 2 * i;
    const std::uint32_t b = 1 + 2 * ((i + 1) % kWalls);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    mesh.triangles.push_back({a + 1, b + 1, tip});
  }
  return mesh;
}

// Area of the regular polygon of 24 corners at 10 mm.
const double kFloor_mm2 = 0.5 * 24 * 100.0 * std::sin(kTurn_rad / 24);

TEST(CapBase, ClosesARimThatLiesInTheBase) {
  const Mesh tent = openTent([](std::uint32_t) { return 0.0; });
  const auto capped = capBase(tent, {}, {});
  ASSERT_TRUE(capped);
  const MeshHealth health = meshHealth(capped->mesh);
  EXPECT_EQ(capped->rims_closed, 1U);
  EXPECT_EQ(health.genus, 0);
  EXPECT_NEAR(capped->base_mm2, kFloor_mm2, 1e-9);
  EXPECT_NEAR(health.volume_mm3, kFloor_mm2 * (20.0 + 10.0 / 3.0), 1e-9);
  EXPECT_NEAR(health.unseen_area_mm2, kFloor_mm2, 1e-9);
  EXPECT_EQ(boundsOf(capped->mesh).min.z(), 0.0);
  EXPECT_EQ(*countSelfIntersections(capped->mesh, {}), 0U);
  for (std::size_t v = 0; v < tent.vertices.size(); ++v) {
    EXPECT_EQ(capped->mesh.vertices[v].position, tent.vertices[v].position);
    EXPECT_EQ(capped->mesh.vertices[v].seen, 1);
  }
}

TEST(CapBase, LeadsAJaggedRimStraightDown) {
  Random random(4);
  const Mesh tent =
      openTent([&](std::uint32_t i) { return i % 5 == 0 ? 0.0 : random.uniform(0, 3); });
  const auto capped = capBase(tent, {}, {});
  ASSERT_TRUE(capped);
  const MeshHealth health = meshHealth(capped->mesh);
  EXPECT_EQ(health.genus, 0);
  EXPECT_NEAR(health.volume_mm3, kFloor_mm2 * (20.0 + 10.0 / 3.0), 1e-9);
  EXPECT_GT(health.unseen_area_mm2, kFloor_mm2);
  EXPECT_GT(capped->tallest_skirt_mm, 2.0);
  EXPECT_EQ(*countSelfIntersections(capped->mesh, {}), 0U);
}

TEST(CapBase, CutsOffWhatLiesBelowTheBase) {
  const Mesh tent = openTent([](std::uint32_t i) { return i % 2 == 0 ? -1.0 : 1.5; });
  const auto capped = capBase(tent, {}, {});
  ASSERT_TRUE(capped);
  EXPECT_EQ(boundsOf(capped->mesh).min.z(), 0.0);
  EXPECT_EQ(meshHealth(capped->mesh).genus, 0);
  EXPECT_NEAR(meshHealth(capped->mesh).volume_mm3, kFloor_mm2 * (20.0 + 10.0 / 3.0), 1e-9);
}

TEST(CapBase, FillsTheRingBetweenTwoRims) {
  const Mesh ring = cropMesh(test::ringMesh(20.0, 5.0, 96), {.z_min_mm = 0.0}, {})->mesh;
  const auto capped = capBase(ring, {}, {});
  ASSERT_TRUE(capped);
  EXPECT_EQ(capped->rims_closed, 2U);
  EXPECT_EQ(meshHealth(capped->mesh).genus, 1);
  EXPECT_NEAR(capped->base_mm2, kPi * (25.0 * 25.0 - 15.0 * 15.0), 3.0);  // polygons of 96 corners
}

TEST(CapBase, SmoothsLinesThatWouldCross) {
  Mesh tent = openTent([](std::uint32_t i) { return i == 7 ? 1.5 : 1.0; });
  // This vertex of the rim overhangs two others.
  tent.vertices[1 + 2 * 7].position.head<2>() =
      12.0 * Eigen::Vector2d(std::cos(0.5), std::sin(0.5));
  const auto capped = capBase(tent, {}, {});
  ASSERT_TRUE(capped);
  EXPECT_EQ(meshHealth(capped->mesh).genus, 0);
  EXPECT_EQ(boundsOf(capped->mesh).min.z(), 0.0);
}

TEST(CapBase, LeavesRimsAboveTheToleranceAndClosedBodies) {
  const Mesh tent = openTent([](std::uint32_t) { return 6.0; });
  EXPECT_EQ(capBase(tent, {}, {})->rims_closed, 0U);
  EXPECT_EQ(capBase(tent, {.tolerance_mm = 7.0}, {})->rims_closed, 1U);
  const Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 2});
  EXPECT_EQ(capBase(box, {}, {})->mesh.triangles, box.triangles);
}

TEST(CapBase, TakesTheColourOfTheRimAndTheSideOfTheMesh) {
  Mesh tent = openTent([](std::uint32_t) { return 0.5; });
  for (MeshVertex& vertex : tent.vertices) vertex.rgb = {9, 99, 199};
  for (Triangle& triangle : tent.triangles) std::swap(triangle[0], triangle[1]);  // inside out
  const auto capped = capBase(tent, {}, {});
  ASSERT_TRUE(capped);
  EXPECT_NEAR(meshHealth(capped->mesh).volume_mm3, -kFloor_mm2 * (20.0 + 10.0 / 3.0), 1e-9);
  for (const MeshVertex& vertex : capped->mesh.vertices) EXPECT_EQ(vertex.rgb[2], 199);
}

// As a surface is closed that no camera could see from below: by a facet at the height of the
// lowest points. The body is led down to the table; without the mark it is measured, and stays.
TEST(CapBase, LeadsABodyDownWhoseBaseIsOnlyGuessed) {
  Mesh body = test::boxMesh({-10, -10, 3}, {10, 10, 30});
  std::erase_if(body.triangles, [&](const Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
      return body.vertices[corner].position.z() == 3.0;
    });
  });
  const std::uint32_t middle = test::addVertex(body, {0, 0, 3});
  for (const auto& [from, to] : {std::pair{0U, 2U}, {2U, 3U}, {3U, 1U}, {1U, 0U}}) {
    body.triangles.push_back({from, to, middle});
  }
  ASSERT_EQ(meshHealth(body).genus, 0);
  const auto measured = capBase(body, {}, {});
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->rims_closed, 0U);
  EXPECT_NEAR(meshHealth(measured->mesh).volume_mm3, 400.0 * 27.0, 1e-9);

  body.vertices[middle].seen = 0;
  const auto guessed = capBase(body, {}, {});
  ASSERT_TRUE(guessed);
  EXPECT_EQ(guessed->rims_closed, 1U);
  const MeshHealth health = meshHealth(guessed->mesh);
  EXPECT_EQ(health.genus, 0);
  EXPECT_EQ(boundsOf(guessed->mesh).min.z(), 0.0);
  EXPECT_NEAR(health.volume_mm3, 400.0 * 30.0, 1e-9);
  // Once there it stays as it is.
  const auto again = capBase(guessed->mesh, {}, {});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->rims_closed, 0U);
  EXPECT_EQ(again->mesh.triangles.size(), guessed->mesh.triangles.size());
}

TEST(CapBase, RefusesAndStops) {
  const Mesh tent = openTent([](std::uint32_t) { return 0.5; });
  EXPECT_EQ(capBase(Mesh{}, {}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(capBase(tent, {.z_mm = 100.0}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(capBase(tent, {.tolerance_mm = -1.0}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(capBase(tent, {}, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
