// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/ring_place.h"

#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "tests/support/turned_target.h"

namespace gyre {
namespace {

using test::TurnedTarget;

// A ring of 24 markers on the default rig's platter, seen all around a turn.
class RingPlaceTest : public testing::Test {
 protected:
  RingPlaceTest() : seen_(test::ringTarget(24, 58.0, 9.0)), known_(seen_.truth) {
    for (const Eigen::Vector3d& point : seen_.true_points) {
      points_.push_back(seen_.table_from_target * point);
    }
  }
  std::optional<RingPlace> place(const TargetView& view) const {
    return placeOfRing(known_, points_, view);
  }

  TurnedTarget seen_;
  Calibration known_;  // what the rig was before anybody touched it
  std::vector<Eigen::Vector3d> points_;
};

double apart(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, kTurn_rad));
}

TEST_F(RingPlaceTest, TellsTheAngleExactlyWithoutNoise) {
  seen_.noise_px = 0.0;
  const auto views = seen_.views(1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto found = place(views[i]);
    ASSERT_TRUE(found);
    EXPECT_LT(apart(found->angle_rad, seen_.true_rad[i]), 1e-9);
    EXPECT_LT(found->px, 1e-6);
    EXPECT_EQ(found->sightings, views[i].sightings.size());
  }
}

TEST_F(RingPlaceTest, KnowsHowSureItIs) {
  double angle_squares = 0.0;
  double px_squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto views = seen_.views(seed);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto found = place(views[i]);
      ASSERT_TRUE(found);
      angle_squares += std::pow(apart(found->angle_rad, seen_.true_rad[i]) / found->sigma_rad, 2);
      px_squares += std::pow(found->px / found->sigma_px, 2);
      EXPECT_LT(found->sigma_rad, radFromDeg(0.005));
      ++count;
    }
  }
  // 480 samples: their variances are known to 6 %, that of five freedoms to 3 %.
  EXPECT_NEAR(angle_squares / count, 1.0, 0.25);
  EXPECT_NEAR(px_squares / count, 1.0, 0.15);
}

TEST_F(RingPlaceTest, TellsByHowMuchTheTableWasPushed) {
  const Eigen::Vector3d push(0.0, 0.8, 0.0);
  seen_.truth.cam_from_table->translation += seen_.truth.cam_from_table->rotation * push;
  for (const TargetView& view : seen_.views(1)) {
    const auto found = place(view);
    ASSERT_TRUE(found);
    // 0.8 mm across are 5.5 px at 350 mm. The ring is seen all around: no angle hides them.
    EXPECT_NEAR(found->px, 5.5, 1.0);
    EXPECT_GT(found->px, 50.0 * found->sigma_px);
  }
}

TEST_F(RingPlaceTest, BearsMarkersThatWereMisread) {
  const auto views = seen_.views(3);
  for (std::size_t i = 0; i < views.size(); ++i) {
    TargetView view = views[i];
    ASSERT_GT(view.sightings.size(), 40U);
    for (std::size_t wrong = 0; wrong < 8; ++wrong) {
      view.sightings[wrong].pixel = view.sightings[wrong + 20].pixel;
    }
    const auto found = place(view);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->sightings, view.sightings.size() - 8);
    EXPECT_LT(apart(found->angle_rad, seen_.true_rad[i]), 6.0 * found->sigma_rad);
  }
}

TEST_F(RingPlaceTest, TakesTwoMarkersAndRefusesFewer) {
  TargetView view = seen_.views(1)[5];
  view.sightings.resize(8);
  const auto found = place(view);
  ASSERT_TRUE(found);
  EXPECT_LT(apart(found->angle_rad, seen_.true_rad[5]), 5.0 * found->sigma_rad);
  view.sightings.resize(7);
  EXPECT_FALSE(place(view));
  view.sightings.clear();
  EXPECT_FALSE(place(view));
}

TEST_F(RingPlaceTest, RefusesSightingsThatAgreeWithNoAngle) {
  TargetView view = seen_.views(1)[0];
  view.sightings.resize(10);
  for (std::size_t i = 0; i < view.sightings.size(); ++i) {
    const double odd = i % 2 == 0 ? 1.0 : -1.0;
    view.sightings[i].pixel = {640.0 + odd * 60.0 * static_cast<double>(i), 500.0 - 30.0 * odd};
  }
  const auto found = place(view);
  // What is left of it must call itself unsure.
  EXPECT_TRUE(!found || found->sigma_rad > radFromDeg(0.05));
}

}  // namespace
}  // namespace gyre
