// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/plane_homography.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace gyre {
namespace {

Eigen::Matrix3d truth() {
  Eigen::Matrix3d h;
  h << 30.0, 4.0, 320.0, -3.0, 26.0, 240.0, 0.01, 0.02, 1.0;
  return h;
}

std::vector<PlaneSighting> gridSeen(double noise_px) {
  Random random(7);
  std::vector<PlaneSighting> seen;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      const Eigen::Vector2d place(x, y);
      seen.push_back({place, throughHomography(truth(), place) +
                                 noise_px * Eigen::Vector2d(random.gaussian(), random.gaussian())});
    }
  }
  return seen;
}

TEST(PlaneHomography, RecoversAnExactMap) {
  const auto fitted = fitHomography(gridSeen(0.0));
  ASSERT_TRUE(fitted.has_value());
  const Eigen::Vector2d place(8.0, -3.0);
  EXPECT_LT((throughHomography(*fitted, place) - throughHomography(truth(), place)).norm(), 1e-6);
}

TEST(PlaneHomography, AveragesNoiseOut) {
  const auto fitted = fitHomography(gridSeen(0.1));
  ASSERT_TRUE(fitted.has_value());
  const Eigen::Vector2d middle(2.5, 2.5);
  // 8 parameters from 72 numbers: the middle is known to about a third of the noise.
  EXPECT_LT((throughHomography(*fitted, middle) - throughHomography(truth(), middle)).norm(), 0.1);
}

TEST(PlaneHomography, PrefersWhatIsNear) {
  auto seen = gridSeen(0.0);
  for (auto& sighting : seen) {
    if (sighting.place.x() > 3.5) sighting.pixel.x() += 5.0;
  }
  const auto fitted = fitHomographyNear(seen, {0.0, 0.0}, 9);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_LT(
      (throughHomography(*fitted, {0.5, 0.5}) - throughHomography(truth(), {0.5, 0.5})).norm(),
      1e-6);
}

TEST(PlaneHomography, GivesNothingForALineOrTooFew) {
  std::vector<PlaneSighting> line;
  for (int x = 0; x < 8; ++x) line.push_back({Eigen::Vector2d(x, 0), Eigen::Vector2d(20 * x, 5)});
  EXPECT_FALSE(fitHomography(line));
  const auto seen = gridSeen(0.0);
  EXPECT_FALSE(fitHomography(std::span(seen).first(3)));
}

TEST(PlaneHomography, KnowsHowAPlaceStretches) {
  const Eigen::Vector2d place(2.0, 3.0);
  const Eigen::Matrix2d jacobian = homographyJacobian(truth(), place);
  const Eigen::Vector2d step(1e-6, 0.0);
  const Eigen::Vector2d moved =
      throughHomography(truth(), place + step) - throughHomography(truth(), place);
  EXPECT_LT((moved / 1e-6 - jacobian.col(0)).norm(), 1e-3);
  EXPECT_LE(leastStretch(jacobian), jacobian.col(0).norm() + 1e-12);
}

}  // namespace
}  // namespace gyre
