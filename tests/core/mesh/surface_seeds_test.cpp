// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_seeds.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 10.0;

PointCloud ball(std::size_t count) {
  PointCloud cloud = test::sphereCloud(count, kRadius_mm);
  for (Point& point : cloud.points) point.normal = point.position.normalized();
  return cloud;
}

double nearestMm(const PointCloud& cloud, const Eigen::Vector3d& position) {
  double nearest_mm = 1e300;
  for (const Point& point : cloud.points) {
    nearest_mm = std::min(nearest_mm, (point.position - position).norm());
  }
  return nearest_mm;
}

TEST(SurfaceSeeds, LieOnTheBentSurfaceWithItsNormal) {
  const PointCloud cloud = ball(1000);  // 1.1 mm apart
  SurfaceSeeds places(0.5);
  for (const Point& point : cloud.points) places.occupy(point);
  const auto seeds = places.around(cloud, 0, pointSurfaces(cloud));
  ASSERT_GT(seeds.size(), 2000U);
  for (const SurfaceSeed& seed : seeds) {
    // Flat, they would lie 0.0125 mm above the ball.
    EXPECT_NEAR(seed.position.norm(), kRadius_mm, 0.003);
    EXPECT_GT(seed.normal.dot(seed.position.normalized()), 0.9995);
    EXPECT_LT(seed.parent, cloud.points.size());
  }
}

TEST(SurfaceSeeds, KeepAwayFromPointsAndFromEachOther) {
  const PointCloud cloud = ball(1000);
  SurfaceSeeds places(0.5);
  for (const Point& point : cloud.points) places.occupy(point);
  const auto seeds = places.around(cloud, 0, pointSurfaces(cloud));
  for (std::size_t i = 0; i < seeds.size(); i += 17) {
    EXPECT_GE(nearestMm(cloud, seeds[i].position), 0.37);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((seeds[i].position - seeds[k].position).norm(), 0.24);
    }
  }
}

TEST(SurfaceSeeds, AreGivenOnceAndTakenOnce) {
  PointCloud cloud = ball(1000);
  SurfaceSeeds places(0.5);
  for (const Point& point : cloud.points) places.occupy(point);
  const auto surfaces = pointSurfaces(cloud);
  const auto seeds = places.around(cloud, 0, surfaces);
  EXPECT_TRUE(places.around(cloud, 0, surfaces).empty());
  Point point;
  point.position = seeds.front().position;
  point.normal = seeds.front().normal;
  EXPECT_TRUE(places.take(point));
  EXPECT_FALSE(places.take(point));
}

// Two sheets 0.2 mm apart that look away from each other, as the sides of a leaf.
TEST(SurfaceSeeds, OfOneSideOfALeafAreNotInTheWayOfTheOther) {
  SurfaceSeeds places(0.5);
  Point front;
  front.position = {0, 0, 0.1};
  front.normal = Eigen::Vector3d::UnitZ();
  Point back = front;
  back.position.z() = -0.1;
  back.normal *= -1.0;
  places.occupy(front);
  EXPECT_TRUE(places.take(back));
}

TEST(SurfaceSeeds, AreNoneWithoutAnEdgeToGoOnFrom) {
  SurfaceSeeds places(0.5);
  EXPECT_TRUE(places.around({}, 0, {}).empty());
  PointCloud alone;
  alone.points.resize(1);
  alone.points[0].normal = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(places.around(alone, 0, pointSurfaces(alone)).empty());
}

// Growing from what was taken, round after round, covers the whole ball and ends.
TEST(SurfaceSeeds, GrowOverAClosedSurfaceAndEnd) {
  PointCloud cloud = ball(1000);
  std::erase_if(cloud.points, [](const Point& point) { return point.position.z() > 2.0; });
  SurfaceSeeds places(0.8);
  for (const Point& point : cloud.points) places.occupy(point);
  int rounds = 0;
  for (std::size_t first = 0; first < cloud.points.size() && rounds < 100; ++rounds) {
    const std::size_t known = cloud.points.size();
    for (const SurfaceSeed& seed : places.around(cloud, first, pointSurfaces(cloud, first))) {
      Point point;
      point.position = kRadius_mm * seed.position.normalized();  // as if measured
      point.normal = point.position.normalized();
      if (places.take(point)) cloud.points.push_back(point);
    }
    first = known;
  }
  EXPECT_LT(rounds, 100);
  for (const Point& place : ball(200).points) EXPECT_LT(nearestMm(cloud, place.position), 0.8);
}

}  // namespace
}  // namespace gyre
