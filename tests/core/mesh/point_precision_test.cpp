// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_precision.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 20.0;

// Known well along x on the side of +z, and badly on the other.
PointCloud measuredSphere() {
  PointCloud cloud = test::sphereCloud(2000, kRadius_mm);
  for (Point& point : cloud.points) {
    const double sigma_mm = point.position.z() > 0.0 ? 0.01 : 0.1;
    point.covariance.diagonal() =
        Eigen::Vector3d(sigma_mm * sigma_mm, 4.0 * sigma_mm * sigma_mm, 0.0);
  }
  return cloud;
}

TEST(PointPrecision, IsThatOfThePointsAround) {
  const PointPrecision precision(measuredSphere());
  const auto above = precision.covarianceAt({0, 0, kRadius_mm});
  ASSERT_TRUE(above);
  EXPECT_DOUBLE_EQ((*above)(0, 0), 1e-4);
  EXPECT_DOUBLE_EQ((*above)(1, 1), 4e-4);
  EXPECT_DOUBLE_EQ((*precision.covarianceAt({0, 0, -kRadius_mm}))(0, 0), 1e-2);
}

TEST(PointPrecision, IsNotMovedByOneBadPoint) {
  PointCloud cloud = measuredSphere();
  cloud.points[0].covariance *= 1e6;  // at the top
  const auto above = PointPrecision(cloud).covarianceAt(cloud.points[0].position);
  ASSERT_TRUE(above);
  EXPECT_DOUBLE_EQ((*above)(0, 0), 1e-4);
}

TEST(PointPrecision, IsUnknownAwayFromPointsAndWherePointsDoNotTell) {
  const PointPrecision precision(measuredSphere());
  EXPECT_FALSE(precision.covarianceAt({0, 0, 0}));
  EXPECT_FALSE(precision.covarianceAt({0, 0, kRadius_mm + 5.0}));
  EXPECT_FALSE(PointPrecision(PointCloud{}).covarianceAt({0, 0, 0}));
  const PointPrecision silent(test::sphereCloud(2000, kRadius_mm));
  EXPECT_FALSE(silent.covarianceAt({0, 0, kRadius_mm}));
}

TEST(PointPrecision, OfAMeshIsNeverTooSmallAndLeavesOutTheGuessed) {
  Mesh mesh = test::sphereMesh(kRadius_mm);
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.sigma_mm = 0.5F;
    vertex.seen = vertex.position.z() > 0.0 ? 1 : 0;
  }
  const PointPrecision precision(mesh);
  const auto above = precision.covarianceAt({12, 0, 16});
  ASSERT_TRUE(above);
  EXPECT_DOUBLE_EQ((*above)(2, 2), 0.25);
  EXPECT_FALSE(precision.covarianceAt({12, 0, -16}));
}

TEST(PickNearest, LandsOnTheSurfaceAndTellsWhetherItWasSeen) {
  Mesh square = test::squareMesh(10.0, 2.0);
  for (MeshVertex& vertex : square.vertices) vertex.seen = vertex.position.x() < 0.0 ? 1 : 0;
  PointCloud cloud;
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      Point point = test::surfacePoint(Eigen::Vector3d(x, y, 2.0), Eigen::Vector3d::UnitZ());
      point.covariance.setIdentity();
      cloud.points.push_back(point);
    }
  }
  const SurfaceIndex surface(square);
  const PointPrecision precision(cloud);
  const PickedPoint corner = pickNearest(square, surface, precision, {-9, 0, 7});
  EXPECT_LT((corner.position - Eigen::Vector3d(-5, 0, 2)).norm(), 1e-12);
  EXPECT_TRUE(corner.seen);
  EXPECT_TRUE(corner.covariance);
  const PickedPoint middle = pickNearest(square, surface, precision, {1, 1, 2.5});
  EXPECT_LT((middle.position - Eigen::Vector3d(1, 1, 2)).norm(), 1e-12);
  EXPECT_FALSE(middle.seen);
  EXPECT_FALSE(middle.covariance);
}

}  // namespace
}  // namespace gyre
