// The ring of markers under an object, in rendered pictures of a table that errs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/platter_ring.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr int kViews = 12;

RigSettings ringRig() {
  RigSettings rig;
  rig.target = "ring";
  rig.once_per_turn_error_deg = 0.3;
  rig.white_error_deg = 0.05;
  return rig;
}

Renderer rendererOf(const RigSettings& rig) {
  const auto target = standardTarget(rig.target);
  return Renderer(rig, PrintedTarget::make(target->target, rig).value());
}

std::int64_t stepsAt(int view) { return 3200 / kViews * view; }

// As the table was told, counting from the scan's first view.
FramePtr viewOf(const Renderer& renderer, int view, std::int64_t lost_steps = 0) {
  auto frame =
      std::make_shared<Frame>(renderer.render(stepsAt(view) - lost_steps, TableLoad::kObject));
  frame->view = view;
  frame->table_angle_rad = kTurn_rad * static_cast<double>(stepsAt(view)) / 3200.0;
  return frame;
}

TEST(PlatterRing, GivesTheAngleOfEveryView) {
  const RigSettings rig = ringRig();
  const Renderer renderer = rendererOf(rig);
  auto ring = PlatterRing::of(trueRecord(rig));
  ASSERT_TRUE(ring);
  double squares = 0.0;
  double told_squares = 0.0;
  for (int view = 0; view < kViews; ++view) {
    const FramePtr told = viewOf(renderer, view);
    const double true_rad = trueAngleRad(rig, stepsAt(view));
    const FramePtr seen = ring->follow(told);
    EXPECT_EQ(seen->image_bgr.data, told->image_bgr.data);
    squares += std::pow(seen->table_angle_rad - true_rad, 2);
    told_squares += std::pow(told->table_angle_rad - true_rad, 2);
  }
  const double rms_deg = degFromRad(std::sqrt(squares / kViews));
  const double told_rms_deg = degFromRad(std::sqrt(told_squares / kViews));
  RecordProperty("rms_deg", std::to_string(rms_deg));
  EXPECT_GT(told_rms_deg, 0.1);
  EXPECT_LT(rms_deg, 0.01);
  const TurningReport report = ring->turning();
  EXPECT_EQ(report.views.size(), std::size_t{kViews});
  EXPECT_NEAR(degFromRad(report.rms_off_rad), told_rms_deg, 0.02);
  EXPECT_FALSE(report.lostSteps());
  EXPECT_THAT(report.sentence, HasSubstr("12 of 12 views"));
  for (const TurnedView& each : report.views) {
    EXPECT_TRUE(each.seen);
    EXPECT_LT(each.sigma_rad, radFromDeg(0.01));
  }
  for (const ViewDrift& each : ring->drift()) {
    EXPECT_TRUE(each.judged);
    EXPECT_FALSE(each.moved) << each.px << " px in view " << each.view;
  }
}

TEST(PlatterRing, KeepsMeasuringWhenTheMotorLosesSteps) {
  const RigSettings rig = ringRig();
  const Renderer renderer = rendererOf(rig);
  auto ring = PlatterRing::of(trueRecord(rig));
  for (int view = 0; view < kViews; ++view) {
    const std::int64_t lost = view < 5 ? 0 : 160;  // 18 deg
    const FramePtr seen = ring->follow(viewOf(renderer, view, lost));
    EXPECT_NEAR(seen->table_angle_rad, trueAngleRad(rig, stepsAt(view) - lost), radFromDeg(0.03));
  }
  EXPECT_TRUE(ring->turning().lostSteps());
  EXPECT_THAT(ring->turning().sentence, HasSubstr("From view 6 on"));
  EXPECT_THAT(ring->turning().sentence, HasSubstr("lost steps"));
}

TEST(PlatterRing, TellsThatTheTableWasPushed) {
  RigSettings rig = ringRig();
  rig.push_mm = 0.5;
  rig.bump_at_deg = 179.0;
  const Renderer renderer = rendererOf(rig);
  auto ring = PlatterRing::of(trueRecord(rig));
  for (int view = 0; view < kViews; ++view) {
    const FramePtr seen = ring->follow(viewOf(renderer, view));
    const ViewDrift& drift = ring->drift().back();
    EXPECT_EQ(drift.moved, view >= kViews / 2) << view;
    EXPECT_NEAR(drift.px, drift.moved ? 3.4 : 0.0, drift.moved ? 1.0 : 0.3);
    // Pushed markers tell no angle; the error of the last good view goes on.
    EXPECT_NEAR(seen->table_angle_rad, trueAngleRad(rig, stepsAt(view)), radFromDeg(0.7));
  }
}

TEST(PlatterRing, GivesTheEmptyTablesAngleToo) {
  const RigSettings rig = ringRig();
  const Renderer renderer = rendererOf(rig);
  auto ring = PlatterRing::of(trueRecord(rig));
  auto empty = std::make_shared<Frame>(renderer.render(400, TableLoad::kEmpty));
  EXPECT_EQ(ring->withSeenAngle(empty), empty);  // before any view
  static_cast<void>(ring->follow(viewOf(renderer, 0)));
  EXPECT_NEAR(ring->withSeenAngle(empty)->table_angle_rad, trueAngleRad(rig, 400),
              radFromDeg(0.02));
  EXPECT_EQ(ring->turning().views.size(), 1U);
}

TEST(PlatterRing, IsNotUsedWhereItWasMoved) {
  const RigSettings rig = ringRig();
  const Renderer renderer = rendererOf(rig);
  CalibrationRecord record = trueRecord(rig);
  record.table_from_target->translation.x() += 1.0;
  auto ring = PlatterRing::of(record);
  for (int view = 0; view < 3; ++view) {
    const FramePtr told = viewOf(renderer, view);
    EXPECT_EQ(ring->follow(told)->table_angle_rad, told->table_angle_rad);
    EXPECT_FALSE(ring->drift().back().moved);
  }
  EXPECT_THAT(ring->turning().sentence, HasSubstr("do not lie where they were calibrated"));
}

TEST(PlatterRing, LeavesTheMotorsAnglesWhereItIsNotSeen) {
  const RigSettings with = ringRig();
  RigSettings without = with;
  without.target.clear();
  const Renderer renderer(without);
  auto ring = PlatterRing::of(trueRecord(with));
  const FramePtr told = viewOf(renderer, 2);
  EXPECT_EQ(ring->follow(told)->table_angle_rad, told->table_angle_rad);
  EXPECT_FALSE(ring->drift().back().judged);
  EXPECT_THAT(ring->turning().sentence, HasSubstr("seen in no view"));
}

TEST(PlatterRing, NeedsARecordOfARing) {
  CalibrationRecord record = trueRecord(ringRig());
  record.target = "wedge";
  EXPECT_FALSE(PlatterRing::of(record));
  record = trueRecord(ringRig());
  record.table_from_target.reset();
  EXPECT_FALSE(PlatterRing::of(record));
  EXPECT_FALSE(PlatterRing::of(CalibrationRecord{}));
}

}  // namespace
}  // namespace gyre
