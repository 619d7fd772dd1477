// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/poisson.h"

#include <cmath>
#include <stop_token>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 20.0;
constexpr double kSpacing_mm = 1.6;  // of 2000 points

// Evenly over a ball, down to the height given.
PointCloud ball(std::size_t count, double lowest_z_mm) {
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    if (kRadius_mm * z < lowest_z_mm) break;
    const double azimuth = static_cast<double>(i) * 2.399963;
    const double r = std::sqrt(1.0 - z * z);
    Point point;
    point.normal = {r * std::cos(azimuth), r * std::sin(azimuth), z};
    point.position = kRadius_mm * point.normal;
    point.rgb = {200, 100, 50};
    point.covariance = 1e-6 * Eigen::Matrix3d::Identity();
    cloud.points.push_back(point);
  }
  return cloud;
}

TEST(PoissonMesh, MakesABall) {
  const auto mesh = poissonMesh(ball(2000, -100.0), {}, {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  const MeshHealth health = meshHealth(*mesh);
  EXPECT_EQ(health.genus, 0);
  const double truth_mm3 = 4.0 / 3.0 * kPi * std::pow(kRadius_mm, 3);
  EXPECT_NEAR(health.volume_mm3, truth_mm3, 0.02 * truth_mm3);
  double sum_mm = 0.0;
  for (const MeshVertex& vertex : mesh->vertices) {
    const double off_mm = std::abs(vertex.position.norm() - kRadius_mm);
    EXPECT_LT(off_mm, 0.5 * kSpacing_mm);
    sum_mm += off_mm;
    EXPECT_EQ(vertex.seen, 1);
    EXPECT_EQ(vertex.rgb, (Rgb{200, 100, 50}));
  }
  EXPECT_LT(sum_mm / static_cast<double>(mesh->vertices.size()), 0.1 * kSpacing_mm);
}

TEST(PoissonMesh, ClosesWhatWasNotSeenAndSaysSo) {
  const auto mesh = poissonMesh(ball(2000, -8.0), {}, {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  const MeshHealth health = meshHealth(*mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_GT(health.unseen_area_mm2, 0.1 * health.area_mm2);
  for (const MeshVertex& vertex : mesh->vertices) {
    if (vertex.position.z() > -6.0) {
      EXPECT_EQ(vertex.seen, 1);
    }
  }
}

TEST(PoissonMesh, RefusesTooFewPointsAndStops) {
  EXPECT_FALSE(poissonMesh({}, {}, {}));
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = poissonMesh(ball(500, -100.0), {}, Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
