// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/stands_as_before.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/sim/renderer.h"
#include "core/sim/rig.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr int kWidth_px = 640;

RigSettings rig() { return atImageWidth(RigSettings{}, kWidth_px); }

cv::Mat shown(const RigSettings& settings, std::int64_t steps) {
  return Renderer(settings).render(steps, TableLoad::kObject).image_bgr;
}

// The same place on another day: a little darker, other noise.
cv::Mat later(const RigSettings& settings, std::int64_t steps) {
  RigSettings now = settings;
  now.exposure_gain = 0.93;
  now.noise_sigma = 2.5;
  return shown(now, steps);
}

TEST(StandsAsBefore, KnowsTheSamePlaceInOtherLight) {
  for (const std::int64_t steps : {0, 800, 1900}) {
    const StandsCheck check = standsAsBefore(shown(rig(), steps), later(rig(), steps));
    EXPECT_TRUE(check.judged);
    EXPECT_TRUE(check.same) << check.sentence;
  }
}

TEST(StandsAsBefore, SeesAnObjectThatWasPushedByAMillimetre) {
  RigSettings pushed = rig();
  pushed.object_offset_mm += 1.0;
  const StandsCheck check = standsAsBefore(shown(rig(), 0), later(pushed, 0));
  EXPECT_TRUE(check.judged);
  EXPECT_FALSE(check.same);
  EXPECT_THAT(check.sentence, HasSubstr("Object or table do not stand"));
}

TEST(StandsAsBefore, SeesAnotherObjectAndATableTurnedByADegree) {
  RigSettings other = rig();
  other.object = "mouse";
  EXPECT_FALSE(standsAsBefore(shown(rig(), 0), later(other, 0)).same);
  EXPECT_FALSE(standsAsBefore(shown(rig(), 0), later(rig(), 9)).same);
}

TEST(StandsAsBefore, SeesACameraThatWasKnockedAndSaysSo) {
  const cv::Mat then = shown(rig(), 0);
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1.0, 0.0, 3.0, 0.0, 1.0, -1.5);
  cv::Mat now;
  cv::warpAffine(later(rig(), 0), now, shift, then.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  const StandsCheck check = standsAsBefore(then, now);
  EXPECT_FALSE(check.same);
  EXPECT_THAT(check.sentence, HasSubstr("The camera was moved"));
}

TEST(StandsAsBefore, JudgesNothingWhereThereIsNothingToSee) {
  const cv::Mat grey(480, 640, CV_8UC3, cv::Scalar::all(90));
  EXPECT_FALSE(standsAsBefore(grey, grey).judged);
  EXPECT_FALSE(standsAsBefore(shown(rig(), 0), grey.rowRange(0, 400)).judged);
  EXPECT_FALSE(standsAsBefore(shown(rig(), 0), grey).same);
}

class TableAngle : public testing::Test {
 protected:
  // Every 15 degrees, the first seven of them.
  TableAngle() {
    ScanSettings settings;
    settings.views = 24;
    store_.emplace(
        ScanStore::create(folder_.path() / "scan", settings, trueCalibration(rig())).value());
    const Renderer renderer(rig());
    for (int view = 0; view < 7; ++view) {
      Frame frame = renderer.render(stepsOf(view), TableLoad::kObject);
      frame.view = view;
      frame.table_angle_rad = kTurn_rad * view / settings.views;
      EXPECT_TRUE(store_->addView(frame, stepsOf(view)));
    }
  }
  static std::int64_t stepsOf(double view) {
    return std::llround(rig().steps_per_turn * view / 24.0);
  }

  TempDir folder_;
  std::optional<ScanStore> store_;
};

TEST_F(TableAngle, IsFoundBetweenViewsAndBeyondThem) {
  for (const double view : {2.4, 6.6, 7.0}) {
    const auto angle_rad = tableAngleIn(later(rig(), stepsOf(view)), *store_, {});
    ASSERT_TRUE(angle_rad) << angle_rad.error().sentence();
    ASSERT_TRUE(*angle_rad) << "view " << view;
    EXPECT_NEAR(degFromRad(**angle_rad), 15.0 * view, 0.3);
  }
}

TEST_F(TableAngle, IsNotGuessedFromAnotherObject) {
  RigSettings other = rig();
  other.object = "mouse";
  other.seed = 77;
  const auto angle_rad = tableAngleIn(later(other, stepsOf(3.3)), *store_, {});
  ASSERT_TRUE(angle_rad);
  EXPECT_FALSE(*angle_rad);
}

TEST_F(TableAngle, StopsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(tableAngleIn(later(rig(), 0), *store_, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
