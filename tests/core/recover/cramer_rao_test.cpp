// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/cramer_rao.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/sim/synthetic_turn.h"

namespace gyre {
namespace {

TEST(MeanNorm, IsKnownForOneTwoAndThreeEqualVariances) {
  const double one = std::sqrt(2.0 / std::numbers::pi);
  EXPECT_NEAR(meanNorm(Eigen::Vector3d(4.0, 0.0, 0.0).asDiagonal()), 2.0 * one, 1e-4);
  EXPECT_NEAR(meanNorm(Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal()),
              std::sqrt(std::numbers::pi / 2.0), 1e-4);
  EXPECT_NEAR(meanNorm(0.01 * Eigen::Matrix3d::Identity()), 0.1 * 2.0 * one, 1e-5);
  EXPECT_EQ(meanNorm(Eigen::Matrix3d::Zero()), 0.0);
}

TEST(MeanNorm, IsTheMeanOfDraws) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d sigma(3.0, 0.5, 0.1);
  const Eigen::Matrix3d covariance =
      turn * sigma.cwiseAbs2().asDiagonal().toDenseMatrix() * turn.transpose();
  Random random(1);
  double sum = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const Eigen::Vector3d draw(random.gaussian(), random.gaussian(), random.gaussian());
    sum += sigma.cwiseProduct(draw).norm() / 200000.0;
  }
  EXPECT_NEAR(meanNorm(covariance), sum, 0.015);
}

// Mean bound over some draws of the paper's experiment. [mm]
double bound(int views, double noise_px, double angle_noise_deg, Solved solved) {
  SyntheticTurnOptions options;
  options.views = views;
  options.noise_px = noise_px;
  options.angle_noise_deg = angle_noise_deg;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SyntheticTurn turn = syntheticTurn(options, seed);
    const std::vector<double> angle_sigma_rad(turn.cam_from_table.size(),
                                              radFromDeg(angle_noise_deg));
    sum += leastMeanError_mm({turn.cam_from_table, turn.points_in_table, angle_sigma_rad,
                              turn.sigma_px / turn.camera.fx},
                             solved);
  }
  return sum / 20.0;
}

// An independent simulation of the same experiment came to these; it knew no angle exactly, not
// even the first.
TEST(LeastMeanError, IsWhatAnIndependentSimulationFound) {
  EXPECT_NEAR(bound(5, 0.0, 0.0, Solved::kAlone), 2.92, 0.15);
  EXPECT_NEAR(bound(20, 0.0, 0.0, Solved::kAlone), 0.37, 0.02);
  EXPECT_NEAR(bound(20, 1.0, 0.0, Solved::kAlone), 1.35, 0.07);
  EXPECT_NEAR(bound(50, 0.0, 0.0, Solved::kAlone), 0.121, 0.006);
  EXPECT_NEAR(bound(200, 0.0, 0.0, Solved::kAlone), 0.045, 0.002);
  EXPECT_NEAR(bound(20, 0.0, 1.0, Solved::kAlone), 1.08, 0.06);
  EXPECT_NEAR(bound(20, 0.0, 1.0, Solved::kJointly), 0.60, 0.04);
  EXPECT_NEAR(bound(20, 0.0, 1.0, Solved::kJointlyUpToTurn), 0.42, 0.03);
  EXPECT_NEAR(bound(50, 0.0, 1.0, Solved::kJointlyUpToTurn), 0.126, 0.007);
  EXPECT_NEAR(bound(200, 0.0, 1.0, Solved::kJointlyUpToTurn), 0.045, 0.003);
}

TEST(LeastMeanError, IsInfiniteWithoutParallax) {
  SyntheticTurnOptions options;
  options.views = 1;
  const SyntheticTurn turn = syntheticTurn(options, 1);
  const std::vector<double> exact = {0.0};
  const BoundScene scene{turn.cam_from_table, turn.points_in_table, exact, 1e-3};
  EXPECT_TRUE(std::isinf(leastMeanError_mm(scene, Solved::kAlone)));
  EXPECT_TRUE(std::isinf(leastMeanError_mm(scene, Solved::kJointly)));
}

TEST(LeastMeanError, IsTheSameForAllWaysWhenTheAnglesAreKnown) {
  const SyntheticTurn turn = syntheticTurn({}, 1);
  const std::vector<double> exact(turn.cam_from_table.size(), 0.0);
  const BoundScene scene{turn.cam_from_table, turn.points_in_table, exact, 1e-3};
  const double alone = leastMeanError_mm(scene, Solved::kAlone);
  EXPECT_NEAR(leastMeanError_mm(scene, Solved::kJointly), alone, 1e-6 * alone);
  EXPECT_LT(leastMeanError_mm(scene, Solved::kJointlyUpToTurn), alone);
}

}  // namespace
}  // namespace gyre
