// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/feature_tracker.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/track/empty_table_mask.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

FramePtr shared(Frame frame) { return std::make_shared<const Frame>(std::move(frame)); }

FeatureTracker trackViews(const test::TurningCylinder& world, int views, double step_deg) {
  FeatureTracker tracker = FeatureTracker::create(world.calibration(), {}, {}).value();
  const EmptyTableMask mask(world.calibration(), shared(world.renderEmpty()));
  for (int view = 0; view < views; ++view) {
    const FramePtr frame = shared(world.render(radFromDeg(step_deg * view)));
    tracker.addFrame(frame, mask.maskOf(*frame));
  }
  return tracker;
}

std::vector<double> distances(const test::TurningCylinder& world, const FeatureTracker& tracker) {
  std::vector<double> all;
  for (const MeasuredTrack* track : tracker.tracks()) {
    if (track->point->parallax_rad < 0.08) continue;
    all.push_back(world.distanceToSurface(track->point->position_in_table));
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(FeatureTracker, PutsPointsOnTheSurfaceAtSmallSteps) {
  const test::TurningCylinder world;
  const auto all = distances(world, trackViews(world, 14, 2.0));
  ASSERT_GT(all.size(), 150U);
  // 0.1 px over 26 degrees at 3.1 px/mm leave about 0.05 mm.
  EXPECT_LT(all[all.size() / 2], 0.1);
  EXPECT_LT(all[all.size() * 9 / 10], 0.4);
}

TEST(FeatureTracker, FollowsTenDegreeStepsByGeometry) {
  const test::TurningCylinder world;
  const auto all = distances(world, trackViews(world, 8, 10.0));
  ASSERT_GT(all.size(), 100U);
  EXPECT_LT(all[all.size() / 2], 0.1);
}

TEST(FeatureTracker, FollowsATableThatTurnsTheOtherWay) {
  const test::TurningCylinder world;
  EXPECT_GT(distances(world, trackViews(world, 8, -3.0)).size(), 100U);
}

TEST(FeatureTracker, TakesNoPointFromPlatterOrWall) {
  const test::TurningCylinder world;
  FeatureTracker tracker = FeatureTracker::create(world.calibration(), {}, {}).value();
  const cv::Mat everywhere(300, 400, CV_8U, cv::Scalar(255));
  for (int view = 0; view < 12; ++view) {
    tracker.addFrame(shared(world.renderEmpty(radFromDeg(2.0 * view))), everywhere);
  }
  int above = 0;
  for (const MeasuredTrack* track : tracker.tracks()) {
    if (track->point->parallax_rad < 0.15) continue;
    const double z_sigma = std::sqrt(track->point->covariance(2, 2));
    if (track->point->position_in_table.z() - 2.0 * z_sigma > 1.0) ++above;
  }
  EXPECT_LT(above, 10);
}

TEST(FeatureTracker, FindsAlmostNothingOnAPlainObject) {
  test::TurningCylinder world;
  world.contrast = 0.0;
  EXPECT_LT(distances(world, trackViews(world, 8, 2.0)).size(), 30U);
}

TEST(FeatureTracker, MarksCarryTheTailsOfFollowedFeatures) {
  const test::TurningCylinder world;
  FeatureTracker tracker = FeatureTracker::create(world.calibration(), {}, {}).value();
  const cv::Mat everywhere(300, 400, CV_8U, cv::Scalar(255));
  TrackedFrame tracked;
  for (int view = 0; view < 6; ++view) {
    tracked = tracker.addFrame(shared(world.render(radFromDeg(2.0 * view))), everywhere);
  }
  const auto longest = std::max_element(
      tracked.marks.begin(), tracked.marks.end(),
      [](const FeatureMark& a, const FeatureMark& b) { return a.tail.size() < b.tail.size(); });
  ASSERT_NE(longest, tracked.marks.end());
  EXPECT_EQ(longest->tail.size(), 6U);
  EXPECT_EQ(longest->state, FeatureState::kMeasured);
}

TEST(FeatureTracker, MeasuresTheGapOfASlippedTurn) {
  const test::TurningCylinder world;
  constexpr int kViews = 45;
  constexpr double kSlip_deg = 0.5;
  const EmptyTableMask mask(world.calibration(), shared(world.renderEmpty()));
  const auto gapOf = [&](double slip_deg) {
    FeatureTracker tracker = FeatureTracker::create(world.calibration(), {}, {}).value();
    for (int view = 0; view < kViews; ++view) {
      const double told_deg = 360.0 * view / kViews;
      Frame frame = world.render(radFromDeg(told_deg + (view > kViews / 4 ? slip_deg : 0.0)));
      frame.table_angle_rad = radFromDeg(told_deg);
      const FramePtr shared_frame = shared(std::move(frame));
      tracker.addFrame(shared_frame, mask.maskOf(*shared_frame));
    }
    const auto closure = tracker.closure();
    return closure ? std::optional(closure->gap) : std::nullopt;
  };
  const auto clean = gapOf(0.0);
  const auto slipped = gapOf(kSlip_deg);
  ASSERT_TRUE(clean && slipped);
  EXPECT_LT(clean->px, 0.4);
  // 0.5 degrees at 30 mm are 0.26 mm where the motion is across the view, less elsewhere.
  EXPECT_GT(slipped->mm, 0.12);
  EXPECT_LT(slipped->mm, 0.35);
}

TEST(FeatureTracker, RefusesACalibrationWithoutATable) {
  Calibration hand_held = test::TurningCylinder{}.calibration();
  hand_held.cam_from_table.reset();
  EXPECT_FALSE(FeatureTracker::create(hand_held, {}, {}));
  TrackOptions wrong;
  wrong.window_px = 1000;
  EXPECT_FALSE(FeatureTracker::create(test::TurningCylinder{}.calibration(), wrong, {}));
}

}  // namespace
}  // namespace gyre
