// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/point_estimator.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr double kFocal_px = 2400.0;

// Camera 350 mm from the axis, looking down 30 degrees at a point 30 mm above the table.
Rigid3 camFromTableAtZero() {
  const Eigen::Vector3d centre(350 * std::cos(0.52), 0, 30 + 350 * std::sin(0.52));
  const Eigen::Vector3d forward = (Eigen::Vector3d(0, 0, 30) - centre).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Rigid3 cam_from_table;
  cam_from_table.rotation.row(0) = right.transpose();
  cam_from_table.rotation.row(1) = forward.cross(right).transpose();
  cam_from_table.rotation.row(2) = forward.transpose();
  cam_from_table.translation = -(cam_from_table.rotation * centre);
  return cam_from_table;
}

struct World {
  int views = 20;
  double step_deg = 1.8;
  double noise_px = 0.0;
  double angle_noise_deg = 0.0;
};

std::vector<Sighting> see(const World& world, const Eigen::Vector3d& point, Random& random) {
  std::vector<Sighting> sightings;
  for (int view = 0; view < world.views; ++view) {
    const double angle_deg =
        view * world.step_deg + (view > 0 ? world.angle_noise_deg * random.gaussian() : 0.0);
    const Eigen::Vector3d in_cam =
        camFromTable(camFromTableAtZero(), radFromDeg(angle_deg)) * point;
    const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
    sightings.push_back({view, in_cam.head<2>() / in_cam.z() + noise * (world.noise_px / kFocal_px),
                         std::max(world.noise_px, 0.01) / kFocal_px});
  }
  return sightings;
}

PointEstimator estimatorFor(const World& world, RecoverOptions options = {}) {
  options.angle_sigma_deg = world.angle_noise_deg;
  PointEstimator estimator = PointEstimator::create(options).value();
  for (int view = 0; view < world.views; ++view) {
    estimator.addPose(camFromTable(camFromTableAtZero(), radFromDeg(view * world.step_deg)));
  }
  return estimator;
}

Eigen::Vector3d pointInSphere(Random& random) {
  Eigen::Vector3d point;
  do {
    point = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (point.squaredNorm() > 1.0);
  return 35.0 * point + Eigen::Vector3d(0, 0, 40);
}

TEST(PointEstimator, IsExactWithoutNoise) {
  const World world;
  Random random(1);
  const Eigen::Vector3d truth(12, -7, 40);
  const auto point = estimatorFor(world).estimate(see(world, truth, random), 1);
  ASSERT_TRUE(point);
  EXPECT_LT((point->position_in_table - truth).norm(), 1e-9);
  EXPECT_EQ(point->agreeing, world.views);
}

// Mean squared error over mean predicted variance, and mean of e^T C^-1 e.
struct Efficiency {
  double ratio = 0.0;
  double nees = 0.0;
};
Efficiency measure(const World& world, int trials) {
  const PointEstimator estimator = estimatorFor(world);
  Random random(5);
  double squared = 0.0;
  double variance = 0.0;
  double nees = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::Vector3d truth = pointInSphere(random);
    const auto point =
        estimator.estimate(see(world, truth, random), static_cast<std::uint64_t>(trial));
    if (!point) continue;
    const Eigen::Vector3d error = point->position_in_table - truth;
    squared += error.squaredNorm();
    variance += point->covariance.trace();
    nees += error.dot(point->covariance.inverse() * error);
  }
  return {squared / variance, nees / trials};
}

TEST(PointEstimator, ErrorIsWhatTheCovarianceSays) {
  // The covariance without widening is the Cramer-Rao bound; widening by the sampled chi2 can only
  // lower the ratio, by at most some percent at 20 views.
  const Efficiency efficiency = measure({20, 1.8, 0.2, 0.0}, 10000);
  EXPECT_NEAR(efficiency.ratio, 1.0, 0.05);
  EXPECT_NEAR(efficiency.nees, 3.0, 0.1);
}

TEST(PointEstimator, ErrorBarsCoverAngleNoiseToo) {
  const Efficiency efficiency = measure({40, 1.8, 0.2, 0.05}, 10000);
  EXPECT_NEAR(efficiency.ratio, 1.0, 0.05);
  EXPECT_NEAR(efficiency.nees, 3.0, 0.1);
}

TEST(PointEstimator, IgnoresAFifthOfWildSightings) {
  const World world{30, 1.8, 0.3, 0.0};
  const PointEstimator estimator = estimatorFor(world);
  Random random(9);
  double worst_mm = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d truth = pointInSphere(random);
    std::vector<Sighting> sightings = see(world, truth, random);
    for (std::size_t i = 0; i < sightings.size(); i += 5) {
      sightings[i].normalized.x() += random.uniform(-40, 40) / kFocal_px;
    }
    const auto point = estimator.estimate(sightings, static_cast<std::uint64_t>(trial));
    ASSERT_TRUE(point);
    worst_mm = std::max(worst_mm, (point->position_in_table - truth).norm());
  }
  // Ten times the typical error of 24 clean views at 0.3 px.
  EXPECT_LT(worst_mm, 0.5);
}

TEST(PointEstimator, RefusesTracksWithoutParallax) {
  const World world{10, 0.2, 0.1, 0.0};
  Random random(1);
  EXPECT_FALSE(estimatorFor(world).estimate(see(world, {12, -7, 40}, random), 1));
}

TEST(PointEstimator, RefusesTooFewViewsAndStandingPoints) {
  const World world;
  Random random(1);
  std::vector<Sighting> sightings = see(world, {12, -7, 40}, random);
  EXPECT_FALSE(estimatorFor(world).estimate({sightings.data(), 2}, 1));
  EXPECT_FALSE(estimatorFor(world).estimate({}, 1));
  for (Sighting& sighting : sightings) sighting.normalized = sightings.front().normalized;
  EXPECT_FALSE(estimatorFor(world).estimate(sightings, 1));
}

TEST(PointEstimator, RefineFollowsANewSighting) {
  const World world{20, 1.8, 0.1, 0.0};
  Random random(1);
  const Eigen::Vector3d truth(12, -7, 40);
  const auto sightings = see(world, truth, random);
  const auto point = estimatorFor(world).refine(sightings, truth + Eigen::Vector3d(0.5, -0.5, 0.3));
  ASSERT_TRUE(point);
  EXPECT_LT((point->position_in_table - truth).norm(), 0.1);
}

TEST(PointEstimator, RefusesOptionsOutOfRange) {
  RecoverOptions options;
  options.min_views = 1;
  EXPECT_FALSE(PointEstimator::create(options));
}

}  // namespace
}  // namespace gyre
