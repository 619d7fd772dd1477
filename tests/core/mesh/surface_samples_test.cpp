// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_samples.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SampleSurface, SpreadsByArea) {
  Mesh two = test::joined(test::squareMesh(30.0, 0.0), test::squareMesh(10.0, 5.0));
  std::size_t upper = 0;
  const auto samples = sampleSurface(two, 10000);
  ASSERT_EQ(samples.size(), 10000U);
  for (const SurfaceSample& sample : samples) upper += sample.position.z() > 2.5;
  EXPECT_NEAR(static_cast<double>(upper), 1000.0, 2.0);  // one tenth of the area, and stratified
}

TEST(SampleSurface, FillsEachTriangleEvenly) {
  Mesh triangle = test::tetrahedronMesh({0, 0, 0}, 6.0);
  triangle.triangles = {{0, 1, 2}};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const SurfaceSample& sample : sampleSurface(triangle, 20000))
    mean += sample.position / 20000.0;
  EXPECT_NEAR((mean - Eigen::Vector3d(2.0, 2.0, 0.0)).norm(), 0.0, 0.05);  // 5 standard errors
}

TEST(SampleSurface, GivesTheSamePlacesAgain) {
  const Mesh sphere = test::sphereMesh(5.0);
  EXPECT_EQ(sampleSurface(sphere, 100)[57].position, sampleSurface(sphere, 100)[57].position);
}

TEST(SampleSurface, TakesCloudsAsTheyAre) {
  Mesh points = test::squareMesh(10.0, 0.0);
  points.triangles.clear();
  EXPECT_EQ(sampleSurface(points, 7).size(), points.vertices.size());
  EXPECT_TRUE(sampleSurface(Mesh{}, 7).empty());
}

TEST(SampleSurface, GivesNothingWithoutArea) {
  Mesh flat = test::tetrahedronMesh({0, 0, 0}, 0.0);
  EXPECT_TRUE(sampleSurface(flat, 10).empty());
}

}  // namespace
}  // namespace gyre
