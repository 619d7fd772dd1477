// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/crop.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(CropMesh, CutsABoxToItsExactArea) {
  const Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 5});
  const auto cropped = cropMesh(box, {.z_min_mm = 0.25, .z_max_mm = 3.0}, {});
  ASSERT_TRUE(cropped);
  const MeshHealth health = meshHealth(cropped->mesh);
  EXPECT_NEAR(health.area_mm2, 8.0 * 2.75, 1e-12);
  EXPECT_EQ(health.holes, 2U);
  EXPECT_EQ(cropped->triangles_removed, 4U);
  EXPECT_EQ(cropped->triangles_cut, 8U + 12U);
  EXPECT_EQ(boundsOf(cropped->mesh).min.z(), 0.25);
  EXPECT_EQ(boundsOf(cropped->mesh).max.z(), 3.0);
  EXPECT_TRUE(checkSurface(cropped->mesh));
}

TEST(CropMesh, CutsAtEveryPlaneOfABox) {
  const Mesh ball = test::ballMesh(10.0, 64);
  CropOptions options;
  options.x_min_mm = -3.0;
  options.x_max_mm = 4.0;
  options.y_min_mm = -5.0;
  options.y_max_mm = 6.0;
  const auto cropped = cropMesh(ball, options, {});
  ASSERT_TRUE(cropped);
  const Bounds bounds = boundsOf(cropped->mesh);
  EXPECT_EQ(bounds.min.x(), -3.0);
  EXPECT_EQ(bounds.max.x(), 4.0);
  EXPECT_EQ(bounds.min.y(), -5.0);
  EXPECT_EQ(bounds.max.y(), 6.0);
  EXPECT_EQ(meshHealth(cropped->mesh).components, 2U);  // above and below
  EXPECT_TRUE(checkSurface(cropped->mesh));
}

TEST(CropMesh, KeepsWhatLiesInTheLowestPlane) {
  const Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 5});
  const auto cropped = cropMesh(box, {.z_min_mm = 0.0}, {});
  ASSERT_TRUE(cropped);
  EXPECT_EQ(cropped->mesh.triangles, box.triangles);
  EXPECT_EQ(cropped->triangles_cut, 0U);
}

TEST(CropMesh, PutsTheRimOnTheCylinder) {
  const auto cropped = cropMesh(test::squareMesh(10.0, 2.0), {.radius_mm = 3.0}, {});
  ASSERT_TRUE(cropped);
  const MeshHealth health = meshHealth(cropped->mesh);
  // Chords of up to 1.5 mm cut off at most 2 % of the disc.
  EXPECT_LT(health.area_mm2, kPi * 9.0);
  EXPECT_GT(health.area_mm2, 0.98 * kPi * 9.0);
  EXPECT_EQ(health.holes, 1U);
  EXPECT_EQ(health.components, 1U);
  for (const MeshVertex& vertex : cropped->mesh.vertices) {
    EXPECT_LE(vertex.position.head<2>().norm(), 3.0 + 1e-12);
  }
  EXPECT_TRUE(checkSurface(cropped->mesh));
}

TEST(CropMesh, FindsTheCylinderWithinLargeTriangles) {
  const Mesh box = test::boxMesh({-50, -40, 0}, {45, 60, 5});
  const auto cropped = cropMesh(box, {.radius_mm = 10.0}, {});
  ASSERT_TRUE(cropped);
  EXPECT_EQ(meshHealth(cropped->mesh).components, 2U);  // a disc of the floor, one of the roof
  EXPECT_TRUE(checkSurface(cropped->mesh));
  Mesh one;  // the axis pierces it, no edge comes near
  test::addVertex(one, {-50, -50, 1});
  test::addVertex(one, {50, -50, 1});
  test::addVertex(one, {0, 70, 1});
  one.triangles = {{0, 1, 2}};
  const auto disc = cropMesh(one, {.radius_mm = 10.0}, {});
  ASSERT_TRUE(disc);
  EXPECT_EQ(disc->mesh.triangles.size(), 3U);
  EXPECT_TRUE(checkSurface(disc->mesh));
}

TEST(CropMesh, BlendsAttributesAlongTheCut) {
  Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 4});
  for (MeshVertex& vertex : box.vertices) {
    const bool high = vertex.position.z() > 0.0;
    vertex.rgb = {static_cast<std::uint8_t>(high ? 200 : 100), 0, 0};
    vertex.sigma_mm = high ? 0.4F : 0.0F;
    vertex.views = high ? 8 : 4;
    vertex.seen = high ? 1 : 0;
  }
  const auto cropped = cropMesh(box, {.z_min_mm = 3.0}, {});
  ASSERT_TRUE(cropped);
  for (const MeshVertex& vertex : cropped->mesh.vertices) {
    if (vertex.position.z() != 3.0) continue;
    EXPECT_EQ(vertex.rgb[0], 175);
    EXPECT_NEAR(vertex.sigma_mm, 0.3, 1e-6);
    EXPECT_EQ(vertex.views, 7);
    EXPECT_EQ(vertex.seen, 1);
  }
}

TEST(CropMesh, LeavesTheInputAndMayLeaveNothing) {
  const Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 4});
  const auto nothing = cropMesh(box, {.z_min_mm = 9.0}, {});
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->mesh.triangles.empty());
  EXPECT_TRUE(nothing->mesh.vertices.empty());
  EXPECT_EQ(box.vertices.size(), 8U);
}

TEST(CropMesh, RefusesLimitsInTheWrongOrderAndBrokenMeshes) {
  const Mesh box = test::boxMesh({-1, -1, 0}, {1, 1, 4});
  EXPECT_EQ(cropMesh(box, {.z_min_mm = 2.0, .z_max_mm = 1.0}, {}).error().code,
            Error::Code::kInvalidInput);
  EXPECT_EQ(cropMesh(box, {.radius_mm = -1.0}, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(cropMesh(Mesh{}, {.radius_mm = 1.0}, {}).error().code, Error::Code::kTooFew);
  Mesh broken = box;
  broken.vertices[3].position.z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cropMesh(broken, {.z_min_mm = 1.0}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(cropMesh(box, {.z_min_mm = 1.0}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
