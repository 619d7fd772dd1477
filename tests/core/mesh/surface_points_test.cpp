// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_points.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(SurfacePoints, AreThinnedByNoise) {
  PointCloud noisy = test::sphereCloud(4000, 20.0);
  test::addNoise(noisy, 0.3, 3);
  const auto points = surfacePoints(noisy, 0.0, {});
  ASSERT_TRUE(points);
  EXPECT_LT(points->cloud.points.size(), 2500U);
  EXPECT_EQ(points->cloud.points.size(), points->spacing_mm.size());
  double worst_mm = 0.0;
  for (const Point& point : points->cloud.points) {
    worst_mm = std::max(worst_mm, std::abs(point.position.norm() - 20.0));
  }
  EXPECT_LT(worst_mm, 0.9);  // unsettled, the worst of 4 000 is 3.7 sigmas off: 1.1
}

TEST(SurfacePoints, KeepWhatIsCertain) {
  const auto points = surfacePoints(test::sphereCloud(2000, 20.0), 0.0, {});
  ASSERT_TRUE(points);
  EXPECT_EQ(points->cloud.points.size(), 2000U);
  const auto sparse = surfacePoints(test::sphereCloud(2000, 20.0), 3.0, {});
  ASSERT_TRUE(sparse);
  EXPECT_LT(sparse->cloud.points.size(), 900U);
}

TEST(SurfacePoints, RefuseWhatIsNoSurface) {
  EXPECT_EQ(surfacePoints({}, 0.0, {}).error().code, Error::Code::kTooFew);
  PointCloud spoilt = test::sphereCloud(100, 20.0);
  spoilt.points[7].position.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(surfacePoints(spoilt, 0.0, {}).error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
