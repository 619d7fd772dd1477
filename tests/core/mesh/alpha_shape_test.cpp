// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_shape.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

using ::testing::HasSubstr;

int eulerNumber(const MeshHealth& health) {  // closed and manifold: three half edges a triangle
  return static_cast<int>(health.vertices) - static_cast<int>(health.triangles) / 2;
}

TEST(AlphaShapeMesh, OfASphereIsAClosedSphere) {
  const auto shape = alphaShapeMesh(test::sphereCloud(4000, 20.0), {}, {});
  ASSERT_TRUE(shape) << shape.error().sentence();
  const MeshHealth health = meshHealth(shape->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.components, 1U);
  EXPECT_EQ(eulerNumber(health), 2);
  EXPECT_NEAR(health.volume_mm3, 4.0 / 3.0 * kPi * 8000.0, 0.01 * 33510.0);
  EXPECT_NEAR(health.area_mm2, 4.0 * kPi * 400.0, 0.01 * 5027.0);
  for (const MeshVertex& vertex : shape->mesh.vertices) {
    EXPECT_GT(vertex.normal.dot(vertex.position.normalized()), 0.95);
  }
}

TEST(AlphaShapeMesh, KeepsTheHoleOfATorus) {
  const auto shape = alphaShapeMesh(test::torusCloud(8000, 20.0, 8.0), {}, {});
  ASSERT_TRUE(shape);
  const MeshHealth health = meshHealth(shape->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.components, 1U);
  EXPECT_EQ(eulerNumber(health), 0);
  EXPECT_NEAR(health.volume_mm3, 2.0 * kPi * kPi * 20.0 * 64.0, 0.02 * 25266.0);
}

TEST(AlphaShapeMesh, BearsNoiseOfATwentiethOfTheSpacing) {
  PointCloud cloud = test::torusCloud(8000, 20.0, 8.0);
  test::addNoise(cloud, 0.05 * std::sqrt(4.0 * kPi * kPi * 160.0 / 8000.0), 11);
  const auto shape = alphaShapeMesh(cloud, {}, {});
  ASSERT_TRUE(shape);
  const MeshHealth health = meshHealth(shape->mesh);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.components, 1U);
  EXPECT_LT(health.boundary_edges, health.triangles / 100);
  EXPECT_NEAR(health.volume_mm3, 2.0 * kPi * kPi * 20.0 * 64.0, 0.02 * 25266.0);
}

TEST(AlphaShapeMesh, CoversABodyOfUnevenDensityAndLeavesItsBaseOpen) {
  const auto shape = alphaShapeMesh(test::unevenBodyCloud(10000, 0.05, 17), {}, {});
  ASSERT_TRUE(shape);
  const MeshHealth health = meshHealth(shape->mesh);
  EXPECT_EQ(health.components, 1U);
  EXPECT_TRUE(health.manifold);
  for (const auto& [a, b, c] : shape->mesh.triangles) {  // nothing spans the inside
    const Eigen::Vector3d middle =
        (shape->mesh.vertices[a].position + shape->mesh.vertices[b].position +
         shape->mesh.vertices[c].position) /
        3.0;
    if (middle.z() > 10.0 && middle.z() < 60.0) {
      EXPECT_GT(middle.head<2>().norm(), 8.0);
    }
  }
}

TEST(AlphaShapeMesh, DropsSmallPieces) {
  PointCloud cloud = test::sphereCloud(4000, 20.0);
  const PointCloud crumb = test::sphereCloud(40, 2.0, {40, 0, 0});
  cloud.points.insert(cloud.points.end(), crumb.points.begin(), crumb.points.end());
  AlphaShapeOptions options;
  EXPECT_EQ(meshHealth(alphaShapeMesh(cloud, options, {})->mesh).components, 1U);
  options.min_component_share = 0.0;
  options.alpha_mm = 2.5;
  EXPECT_EQ(meshHealth(alphaShapeMesh(cloud, options, {})->mesh).components, 2U);
}

TEST(AlphaShapeMesh, CarriesColourSigmaAndViews) {
  PointCloud cloud = test::sphereCloud(1000, 20.0);
  for (Point& point : cloud.points) {
    point.rgb = {10, 20, static_cast<std::uint8_t>(point.position.z() > 0.0 ? 200 : 100)};
    point.views = {1, 5, 9};
  }
  test::addNoise(cloud, 0.001, 2);
  const auto shape = alphaShapeMesh(cloud, {}, {});
  ASSERT_TRUE(shape);
  for (const MeshVertex& vertex : shape->mesh.vertices) {
    if (std::abs(vertex.position.z()) < 0.1) continue;
    EXPECT_EQ(vertex.rgb[2], vertex.position.z() > 0.0 ? 200 : 100);
    EXPECT_EQ(vertex.views, 3U);
    EXPECT_NEAR(vertex.sigma_mm, 0.001 * std::sqrt(3.0), 1e-6);
  }
}

TEST(AlphaShapeMesh, FindsNormalsWhereTheCloudHasNone) {
  PointCloud cloud = test::sphereCloud(3000, 20.0);
  for (Point& point : cloud.points) point.normal.setZero();
  const auto shape = alphaShapeMesh(cloud, {}, {});
  ASSERT_TRUE(shape);
  EXPECT_NEAR(meshHealth(shape->mesh).volume_mm3, 33510.0, 400.0);
}

TEST(AlphaShapeMesh, UsesTheAlphaItIsGiven) {
  AlphaShapeOptions options;
  options.alpha_mm = 3.25;
  EXPECT_EQ(alphaShapeMesh(test::sphereCloud(2000, 20.0), options, {})->alpha_mm, 3.25);
  options.alpha_mm = 1e-3;
  EXPECT_THAT(alphaShapeMesh(test::sphereCloud(2000, 20.0), options, {}).error().what,
              HasSubstr("too far apart"));
  options.alpha_mm = -1.0;
  EXPECT_EQ(alphaShapeMesh(test::sphereCloud(2000, 20.0), options, {}).error().code,
            Error::Code::kInvalidInput);
}

TEST(AlphaShapeMesh, SaysWhyThereIsNone) {
  const auto failure = [](const PointCloud& cloud) {
    return alphaShapeMesh(cloud, {}, {}).error();
  };
  EXPECT_EQ(failure({}).code, Error::Code::kTooFew);

  PointCloud same;
  same.points.assign(50, test::surfacePoint({1, 2, 3}, {0, 0, 1}));
  EXPECT_EQ(failure(same).code, Error::Code::kTooFew);
  PointCloud flat;
  PointCloud line;
  for (int i = 0; i < 100; ++i) {
    flat.points.push_back(test::surfacePoint({1.0 * (i % 10), 1.0 * (i / 10), 0.0}, {0, 0, 1}));
    line.points.push_back(test::surfacePoint({1.0 * i, 0.0, 0.0}, {0, 0, 0}));
  }
  EXPECT_EQ(failure(flat).code, Error::Code::kTooFew);
  EXPECT_EQ(failure(line).code, Error::Code::kTooFew);

  PointCloud not_finite = test::sphereCloud(100, 10.0);
  not_finite.points[7].position.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(failure(not_finite).code, Error::Code::kInvalidInput);
}

TEST(AlphaShapeMesh, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(alphaShapeMesh(test::sphereCloud(500, 10.0), {}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
