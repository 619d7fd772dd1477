// A whole scan on a table that is turned freely, by a person who is not exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/free_hand.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stop_token>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/scan_session.h"
#include "core/base/units.h"
#include "core/io/scan_store.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr int kViews = 24;

RigOptions ringRig() {
  RigOptions options;
  options.sim = atImageWidth(options.sim, 640);
  options.sim.target = "ring";
  options.sim_speed = 50.0;
  return options;
}

// The simulated rig, whose motor is the person's hand: the program reaches it by asking only.
class FreeHand : public testing::Test {
 protected:
  FreeHand() : options_(ringRig()), rig_(openRig("sim", "sim", options_, {}).value()) {
    rig_.room->setTable(TableLoad::kObject);
    hand_ = std::move(rig_.turntable);
  }
  Result<void> watch(const CalibrationRecord& record) {
    return watchByRing(rig_, record, kViews,
                       [this](const FreeTurn& turn) {
                         told_.push_back(turn);
                         // Too little, then too much, then too little; never quite what was asked
                         // for.
                         const double by_deg = turn.by_deg * (told_.size() % 2 == 0 ? 0.9 : 1.15);
                         if (turn.seen)
                           (void)hand_->moveTo(hand_->angleRad() + radFromDeg(by_deg), {});
                       },
                       {});
  }

  RigOptions options_;
  Rig rig_;
  std::unique_ptr<Turntable> hand_;
  std::vector<FreeTurn> told_;
  TempDir temp_;
};

TEST_F(FreeHand, ScansATurnAtTheAnglesThatTheRingShows) {
  const CalibrationRecord record = trueRecord(options_.sim);
  const auto watched = watch(record);
  ASSERT_TRUE(watched) << watched.error().sentence();
  EXPECT_EQ(rig_.turntable->angleRad(), 0.0);
  EXPECT_TRUE(told_.empty());

  ScanPlan plan;
  plan.folder = temp_ / "scan";
  plan.settings.turntable = "hand:free";
  plan.settings.views = kViews;
  plan.calibration = record;
  std::vector<double> off_deg;
  ScanObserver observer;
  observer.on_view = [&](const FramePtr& frame, const Task&) {
    const double true_rad = trueAngleRad(options_.sim, rig_.room->shaft->steps());
    off_deg.push_back(std::abs(degFromRad(frame->table_angle_rad - true_rad)));
    EXPECT_NEAR(frame->table_angle_rad, kTurn_rad * frame->view / kViews,
                0.36 * kTurn_rad / kViews);
  };
  const auto done = runScanSession(rig_, plan, observer, {});
  ASSERT_TRUE(done) << done.error().sentence();
  ASSERT_EQ(off_deg.size(), static_cast<std::size_t>(kViews));
  EXPECT_LT(*std::max_element(off_deg.begin(), off_deg.end()), 0.05);
  EXPECT_GE(told_.size(), static_cast<std::size_t>(kViews - 1));
  EXPECT_GT(done->reconstruction.cloud.points.size(), 500U);
}

TEST_F(FreeHand, GoesOnWhereItWasInterrupted) {
  const CalibrationRecord record = trueRecord(options_.sim);
  ASSERT_TRUE(watch(record));
  ScanPlan plan;
  plan.folder = temp_ / "scan";
  plan.settings.turntable = "hand:free";
  plan.settings.views = kViews;
  plan.calibration = record;
  std::stop_source source;
  ScanObserver observer;
  observer.on_view = [&](const FramePtr& frame, const Task&) {
    if (frame->view == 4) source.request_stop();
  };
  ASSERT_FALSE(runScanSession(rig_, plan, observer, Task(source.get_token())));
  // The program is started anew, and knows nothing of the table but what it sees.
  ASSERT_TRUE(watch(record));
  plan.begin = ScanBegin::kResumed;
  const auto done = runScanSession(rig_, plan, {}, {});
  ASSERT_TRUE(done) << done.error().sentence();
  const auto store = ScanStore::open(temp_ / "scan");
  ASSERT_TRUE(store && store->complete());
  for (const CapturedView& view : store->views()) {
    EXPECT_NEAR(view.table_angle_rad, kTurn_rad * view.view / kViews, 0.36 * kTurn_rad / kViews);
  }
}

TEST_F(FreeHand, NeedsARingThatTheCalibrationKnows) {
  const auto unknown = watch(trueCalibration(options_.sim));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, Error::Code::kInvalidInput);
  EXPECT_THAT(unknown.error().advice, testing::HasSubstr("hand:36"));
  EXPECT_EQ(rig_.turntable, nullptr);
}

TEST_F(FreeHand, SaysThatTheRingIsNotSeen) {
  CalibrationRecord elsewhere = trueRecord(options_.sim);
  elsewhere.table_from_target->translation.x() += 20.0;
  const auto unseen = watch(elsewhere);
  ASSERT_FALSE(unseen);
  EXPECT_EQ(unseen.error().code, Error::Code::kNotFound);
}

TEST(FreeHandWord, IsItsOwn) {
  EXPECT_TRUE(namesFreeHand("hand:free"));
  EXPECT_FALSE(namesFreeHand("hand"));
  EXPECT_FALSE(namesFreeHand("hand:36"));
}

}  // namespace
}  // namespace gyre
