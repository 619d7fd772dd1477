// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/merge_vertices.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

// Every triangle with vertices of its own, as STL files hold them.
Mesh exploded(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : triangle) soup.vertices.push_back(mesh.vertices[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(MergeVertices, ClosesASoupOfTriangles) {
  const auto merged = mergeVertices(exploded(test::boxMesh({0, 0, 0}, {1, 2, 3})), {}, {});
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->mesh.vertices.size(), 8U);
  EXPECT_EQ(merged->vertices_merged, 28U);
  EXPECT_EQ(meshHealth(merged->mesh).genus, 0);
  EXPECT_NEAR(meshHealth(merged->mesh).volume_mm3, 6.0, 1e-12);
}

TEST(MergeVertices, ClosesSeamAndPolesThatRoundingKeepsApart) {
  const auto merged = mergeVertices(test::sphereMesh(10.0), {}, {});
  ASSERT_TRUE(merged);
  EXPECT_EQ(meshHealth(merged->mesh).genus, 0);
  EXPECT_EQ(merged->triangles_removed, 2U * 240U);
}

TEST(MergeVertices, DropsTrianglesThatAreThereTwice) {
  Mesh box = test::boxMesh({0, 0, 0}, {1, 2, 3});
  const auto [a, b, c] = box.triangles[5];
  box.triangles.push_back({b, c, a});
  const auto merged = mergeVertices(box, {}, {});
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->triangles_removed, 1U);
  EXPECT_TRUE(meshHealth(merged->mesh).manifold);
}

TEST(MergeVertices, KeepsTheAttributesOfTheFirst) {
  Mesh soup = exploded(test::tetrahedronMesh({0, 0, 0}, 4.0));
  for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
    soup.vertices[v].rgb = {static_cast<std::uint8_t>(v), 7, 8};
    soup.vertices[v].views = static_cast<std::uint16_t>(v);
  }
  const auto merged = mergeVertices(soup, {}, {});
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->mesh.vertices.size(), 4U);
  EXPECT_EQ(merged->mesh.vertices[1].rgb[0], 1);
  EXPECT_EQ(merged->mesh.vertices[1].views, 1);
}

TEST(MergeVertices, RefusesWhatIsNoMesh) {
  EXPECT_EQ(mergeVertices(Mesh{}, {}, {}).error().code, Error::Code::kTooFew);
  Mesh broken = test::tetrahedronMesh({0, 0, 0}, 1.0);
  broken.vertices[2].position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mergeVertices(broken, {}, {}).error().code, Error::Code::kInvalidInput);
  Mesh dangling = test::tetrahedronMesh({0, 0, 0}, 1.0);
  dangling.triangles[0][0] = 4;
  EXPECT_EQ(mergeVertices(dangling, {}, {}).error().code, Error::Code::kInvalidInput);
  const Mesh whole = test::tetrahedronMesh({0, 0, 0}, 1.0);
  EXPECT_EQ(mergeVertices(whole, {-1.0}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(mergeVertices(whole, {}, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
