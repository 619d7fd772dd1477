// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/mend_self_intersections.h"

#include <algorithm>
#include <array>
#include <stop_token>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// A ring seen all over, one of whose vertices was pushed through the other side of the tube.
Mesh piercedRing() {
  Mesh mesh = test::ringMesh(20.0, 5.0, 48);
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.seen = 7;
    vertex.rgb = {200, 100, 50};
  }
  const auto top = std::max_element(
      mesh.vertices.begin(), mesh.vertices.end(),
      [](const MeshVertex& a, const MeshVertex& b) { return a.position.z() < b.position.z(); });
  top->position.z() = -7.0;
  computeNormals(mesh);
  return mesh;
}

TEST(MendSelfIntersections, MendsThePlaceAndLeavesTheRest) {
  const Mesh pierced = piercedRing();
  const auto mended = mendSelfIntersections(pierced, {});
  ASSERT_TRUE(mended) << mended.error().sentence();
  EXPECT_GT(mended->pairs_before, 0U);
  EXPECT_EQ(mended->pairs_left, 0U);
  const auto health = wholeHealth(mended->mesh, {});
  ASSERT_TRUE(health);
  EXPECT_EQ(health->self_intersections, 0U);
  EXPECT_TRUE(health->closed);
  EXPECT_EQ(health->genus, 1);
  EXPECT_EQ(health->components, 1U);
  // The truth is the ring before it was pierced.
  const MeshHealth ring = meshHealth(test::ringMesh(20.0, 5.0, 48));
  EXPECT_NEAR(health->volume_mm3, ring.volume_mm3, 0.01 * ring.volume_mm3);
  std::size_t unseen = 0;
  for (const MeshVertex& vertex : mended->mesh.vertices) {
    EXPECT_EQ(vertex.rgb, (Rgb{200, 100, 50}));
    EXPECT_NEAR(vertex.normal.norm(), 1.0, 1e-6);
    if (vertex.seen == 0) ++unseen;
  }
  EXPECT_LT(unseen, mended->mesh.vertices.size() / 4);
}

// Where they lie, in an order that does not depend on their numbers.
std::vector<std::array<double, 9>> placesOfSeen(const Mesh& mesh) {
  std::vector<std::array<double, 9>> all;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<std::array<double, 3>, 3> corners{};
    bool seen = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshVertex& vertex = mesh.vertices[triangle[i]];
      corners[i] = {vertex.position.x(), vertex.position.y(), vertex.position.z()};
      seen = seen && vertex.seen != 0;
    }
    std::sort(corners.begin(), corners.end());
    if (!seen) continue;
    std::array<double, 9>& places = all.emplace_back();
    for (std::size_t i = 0; i < 9; ++i) places[i] = corners[i / 3][i % 3];
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(MendSelfIntersections, CallsNothingSeenThatWasNotThere) {
  const Mesh pierced = piercedRing();
  const auto mended = mendSelfIntersections(pierced, {});
  ASSERT_TRUE(mended) << mended.error().sentence();
  const auto before = placesOfSeen(pierced);
  const auto after = placesOfSeen(mended->mesh);
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
  EXPECT_GT(after.size(), before.size() / 2);
}

TEST(MendSelfIntersections, LeavesAProperBodyAsItIs) {
  const Mesh box = test::boxMesh({0, 0, 0}, {1, 2, 3});
  const auto mended = mendSelfIntersections(box, {});
  ASSERT_TRUE(mended);
  EXPECT_EQ(mended->pairs_before, 0U);
  EXPECT_EQ(mended->mesh.triangles, box.triangles);
}

// Two bodies through each other are no fault of a few triangles: they stay two, closed.
TEST(MendSelfIntersections, KeepsWhatItCannotMend) {
  const Mesh boxes =
      test::joined(test::boxMesh({0, 0, 0}, {4, 4, 4}), test::boxMesh({1, 1, -1}, {2, 2, 5}));
  const auto mended = mendSelfIntersections(boxes, {});
  ASSERT_TRUE(mended) << mended.error().sentence();
  EXPECT_GT(mended->pairs_before, 0U);
  EXPECT_LE(mended->pairs_left, mended->pairs_before);
  const MeshHealth health = meshHealth(mended->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_EQ(health.components, 2U);
  EXPECT_EQ(countSelfIntersections(mended->mesh, {}).value(), mended->pairs_left);
}

TEST(MendSelfIntersections, RefusesWhatIsNoSurfaceAndStops) {
  EXPECT_EQ(mendSelfIntersections(Mesh{}, {}).error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = mendSelfIntersections(piercedRing(), Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

TEST(MendSelfIntersections, StopsInTheMiddleOfTheRepair) {
  std::stop_source stop;
  const Task task(stop.get_token(), [&](double, std::string_view stage) {
    if (stage == "Mending self-intersections") stop.request_stop();
  });
  const auto stopped = mendSelfIntersections(piercedRing(), task);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
