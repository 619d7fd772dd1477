// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_index.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SurfaceIndex, MeasuresToFaceEdgeAndCorner) {
  const Mesh square = test::squareMesh(10.0, 2.0);
  const SurfaceIndex index(square);
  EXPECT_NEAR(index.nearest({1.3, -2.2, 5.0}).distance_mm, 3.0, 1e-12);  // above the face
  EXPECT_NEAR(index.nearest({9.0, 0.3, 5.0}).distance_mm, 5.0, 1e-12);   // beside an edge: 4, 3
  EXPECT_NEAR(index.nearest({7.0, 8.0, 8.0}).distance_mm, 7.0, 1e-12);   // off a corner: 2, 3, 6
  EXPECT_NEAR(index.normalAt(index.nearest({1.0, 1.0, 5.0})).z(), 1.0, 1e-12);
}

TEST(SurfaceIndex, AgreesWithTheNearestOfAllTriangles) {
  const Mesh sphere = test::sphereMesh(10.0);
  const SurfaceIndex index(sphere);
  Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Vector3d place(random.uniform(-15, 15), random.uniform(-15, 15),
                                random.uniform(-15, 15));
    double nearest_mm = 1e9;
    for (const Triangle& triangle : sphere.triangles) {
      Mesh one;
      for (const std::uint32_t corner : triangle) one.vertices.push_back(sphere.vertices[corner]);
      one.triangles = {{0, 1, 2}};
      nearest_mm = std::min(nearest_mm, SurfaceIndex(one).nearest(place).distance_mm);
    }
    EXPECT_NEAR(index.nearest(place).distance_mm, nearest_mm, 1e-12);
  }
}

TEST(SurfaceIndex, TakesAMeshWithoutTrianglesAsPoints) {
  Mesh points = test::squareMesh(10.0, 0.0);
  points.triangles.clear();
  EXPECT_NEAR(SurfaceIndex(points).nearest({0.5, 0.0, 0.0}).distance_mm, 0.5, 1e-12);
}

TEST(SurfaceIndex, MeasuresToTrianglesWithoutArea) {
  Mesh sliver = test::tetrahedronMesh({0, 0, 0}, 4.0);
  sliver.vertices[2].position = {2, 0, 0};  // on the edge from 0 to 1
  sliver.triangles = {{0, 1, 2}};
  EXPECT_NEAR(SurfaceIndex(sliver).nearest({3.0, 1.0, 0.0}).distance_mm, 1.0, 1e-12);
  EXPECT_TRUE(SurfaceIndex(sliver).normalAt(SurfaceHit{}).isZero());
}

TEST(SurfaceIndex, BlendsTheNumberOfViews) {
  Mesh triangle = test::tetrahedronMesh({0, 0, 0}, 4.0);
  triangle.triangles = {{0, 1, 2}};
  triangle.vertices[1].views = 8;
  const SurfaceIndex index(triangle);
  EXPECT_NEAR(index.viewsAt(index.nearest({2.0, 0.0, 1.0})), 4.0, 1e-12);
}

}  // namespace
}  // namespace gyre
