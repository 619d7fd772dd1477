// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/distance_lattice.h"

#include <atomic>
#include <stop_token>

#include <gtest/gtest.h>

namespace gyre {
namespace {

double ball(const Eigen::Vector3d& place) { return place.norm() - 10.0; }

const Eigen::AlignedBox3d kBox(Eigen::Vector3d::Constant(-11.0), Eigen::Vector3d::Constant(11.0));

TEST(SampleDistance, HoldsTheFunctionNearTheSurfaceAndItsSignElsewhere) {
  const DistanceLattice lattice = sampleDistance(ball, kBox, 0.5);
  std::size_t near = 0;
  for (int z = 0; z < lattice.size.z(); ++z) {
    for (int y = 0; y < lattice.size.y(); ++y) {
      for (int x = 0; x < lattice.size.x(); ++x) {
        const double truth = ball(lattice.at({x, y, z}));
        EXPECT_EQ(lattice.inside({x, y, z}), truth < 0.0);
        if (std::abs(truth) > 1.0) continue;
        EXPECT_NEAR(lattice.value({x, y, z}), truth, 1e-5);
        ++near;
      }
    }
  }
  EXPECT_GT(near, 10000U);
}

TEST(SampleDistance, ReachesBeyondTheBoxAndAsksLessThanEveryPoint) {
  std::atomic<std::size_t> asked = 0;
  const auto counting = [&](const Eigen::Vector3d& place) {
    ++asked;
    return ball(place);
  };
  const DistanceLattice lattice = sampleDistance(counting, kBox, 0.2);
  EXPECT_LT(lattice.at({0, 0, 0}).maxCoeff(), -11.2);
  EXPECT_GT(lattice.at(lattice.size - 1).minCoeff(), 11.2);
  EXPECT_LT(asked, lattice.values.size() / 2);
}

TEST(SampleDistance, StopsAtOnce) {
  std::stop_source stop;
  stop.request_stop();
  std::atomic<int> asked = 0;
  const auto counting = [&](const Eigen::Vector3d& place) {
    ++asked;
    return ball(place);
  };
  sampleDistance(counting, kBox, 0.2, {}, Task(stop.get_token()));
  EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace gyre
