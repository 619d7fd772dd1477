// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/drift_monitor.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr int kWidth_px = 480;
constexpr int kHeight_px = 360;
constexpr int kViews = 8;
const Eigen::Vector2d kSize_px(kWidth_px, kHeight_px);
const Eigen::Vector2d kMiddle(0.5 * (kWidth_px - 1), 0.5 * (kHeight_px - 1));

// A textured wall, a textured disc that turns before it, and what may happen to a picture of them.
struct Scene {
  SharedMotion bump;    // how the picture is moved
  double gain = 1.0;    // of the light
  double offset = 0.0;  // grey levels
  double noise = 2.0;   // grey levels
  double contrast = 1.0;
  int person_left_px = kWidth_px;  // a textured person covers from here to 30 % of the width on
  bool covered = false;
};

Frame picture(const Scene& scene, int view) {
  Frame frame;
  frame.view = view;
  frame.table_angle_rad = kTurn_rad * view / kViews;
  frame.image_bgr.create(kHeight_px, kWidth_px, CV_8UC3);
  const double c = std::cos(frame.table_angle_rad);
  const double s = std::sin(frame.table_angle_rad);
  parallelFor(kHeight_px, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      Random random(hashWords({static_cast<std::uint64_t>(view), row}));
      auto* line = frame.image_bgr.ptr<cv::Vec3b>(static_cast<int>(row));
      for (int column = 0; column < kWidth_px; ++column) {
        const Eigen::Vector2d seen = Eigen::Vector2d(column, static_cast<double>(row)) - kMiddle;
        const Eigen::Vector2d x = seen - scene.bump.at(seen);  // exact to the bump's square
        const Eigen::Vector2d on_disc = x - Eigen::Vector2d(0.0, 60.0);
        double value = 100.0 + 60.0 * scene.contrast * test::pattern(x.x() / 5, x.y() / 5, 3);
        if (on_disc.norm() < 110.0) {
          const Eigen::Vector2d turned(c * on_disc.x() + s * on_disc.y(),
                                       c * on_disc.y() - s * on_disc.x());
          value = 110.0 + 60.0 * test::pattern(turned.x() / 5, turned.y() / 5, 4);
        }
        const int into_person = column - scene.person_left_px;
        if (into_person >= 0 && into_person < 3 * kWidth_px / 10) {
          value = 90.0 + 70.0 * test::pattern(into_person / 5.0, seen.y() / 5, 5);
        }
        if (scene.covered) value = 30.0;
        value = scene.gain * value + scene.offset + scene.noise * random.gaussian();
        const auto grey = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
        line[column] = {grey, grey, grey};
      }
    }
  });
  return frame;
}

DriftReport watch(const std::function<Scene(int view)>& scene_of) {
  DriftMonitor monitor;
  for (int view = 0; view < kViews; ++view) monitor.addFrame(picture(scene_of(view), view));
  return monitor.report();
}

Scene shifted(double by_px) {
  Scene scene;
  scene.bump.shift_px = by_px * Eigen::Vector2d(0.6, -0.8);
  return scene;
}

int countMoved(const DriftReport& report) {
  return static_cast<int>(std::count_if(report.views.begin(), report.views.end(),
                                        [](const ViewDrift& view) { return view.moved; }));
}

TEST(DriftMonitor, CallsAStillCameraStillThroughNoiseFlickerAndLight) {
  const DriftReport report = watch([](int view) {
    Scene scene;
    scene.gain = 1.0 + 0.1 * std::sin(3.0 * view);
    scene.offset = view > 4 ? -15.0 : 0.0;
    return scene;
  });
  ASSERT_EQ(report.views.size(), static_cast<std::size_t>(kViews));
  for (const ViewDrift& view : report.views) {
    EXPECT_TRUE(view.judged) << view.view;
    EXPECT_FALSE(view.moved) << view.view;
    EXPECT_LT(view.px, 0.05) << view.view;
  }
  EXPECT_THAT(report.sentence, HasSubstr("stood still"));
}

// 40 px is found again by looking everywhere.
class DriftMonitorBump : public testing::TestWithParam<double> {};

TEST_P(DriftMonitorBump, IsMeasuredFromTheViewOnAtWhichItHappened) {
  const DriftReport report = watch([](int view) { return shifted(view < 3 ? 0.0 : GetParam()); });
  for (const ViewDrift& view : report.views) {
    EXPECT_TRUE(view.judged) << view.view;
    EXPECT_EQ(view.moved, view.view >= 3) << view.view;
    // Twice the interpolation's own error.
    EXPECT_NEAR(view.px, view.view < 3 ? 0.0 : GetParam(), 0.04) << view.view;
  }
  ASSERT_NE(report.firstMoved(), nullptr);
  EXPECT_EQ(report.firstMoved()->view, 3);
  EXPECT_THAT(report.sentence, HasSubstr("from view 4 on"));
}
INSTANTIATE_TEST_SUITE_P(Sizes, DriftMonitorBump, testing::Values(0.3, 1.0, 5.0, 40.0));

TEST(DriftMonitor, SeesATurnOfATenthOfADegree) {
  const DriftReport report = watch([](int view) {
    Scene scene;
    scene.bump.turn_rad = view < 5 ? 0.0 : radFromDeg(0.1);
    return scene;
  });
  EXPECT_EQ(countMoved(report), kViews - 5);
  const double expected_px = radFromDeg(0.1) * std::sqrt(kSize_px.squaredNorm() / 12.0);
  EXPECT_NEAR(report.views.back().px, expected_px, 0.03);
}

TEST(DriftMonitor, TellsABumpThatComesBack) {
  const DriftReport report =
      watch([](int view) { return shifted(view == 3 || view == 4 ? 1.0 : 0.0); });
  EXPECT_EQ(countMoved(report), 2);
  EXPECT_THAT(report.sentence, HasSubstr("from view 4 on"));
  EXPECT_THAT(report.sentence, HasSubstr("until view 5"));
}

TEST(DriftMonitor, JudgesTheViewsBeforeTheTableHasTurnedFarAfterwards) {
  DriftMonitor monitor;
  for (int view = 0; view < kViews; ++view) {
    Frame frame = picture(shifted(view < 1 ? 0.0 : 1.0), view);
    if (view == 1) {  // the table has hardly turned
      frame = picture(shifted(1.0), 0);
      frame.view = 1;
      frame.table_angle_rad = radFromDeg(2.0);
    }
    monitor.addFrame(frame);
    if (view == 1) {
      EXPECT_FALSE(monitor.latest().judged);
    }
  }
  EXPECT_TRUE(monitor.report().views[1].moved);
  EXPECT_TRUE(monitor.latest().moved);
}

TEST(DriftMonitor, IgnoresAPersonWhoWalksThroughAThirdOfThePicture) {
  const DriftReport report = watch([](int view) {
    Scene scene;
    if (view > 1) scene.person_left_px = 60 * view - 100;
    return scene;
  });
  EXPECT_EQ(countMoved(report), 0);
  EXPECT_THAT(report.sentence, HasSubstr("stood still"));
}

TEST(DriftMonitor, SeesABumpBehindAPerson) {
  const DriftReport report = watch([](int view) {
    Scene scene = shifted(view < 4 ? 0.0 : 1.0);
    if (view > 1) scene.person_left_px = 60 * view - 100;
    return scene;
  });
  EXPECT_EQ(countMoved(report), kViews - 4);
}

TEST(DriftMonitor, SaysThatABackgroundWithoutTextureTellsNothing) {
  const DriftReport report = watch([](int view) {
    Scene scene = shifted(view < 4 ? 0.0 : 1.0);
    scene.contrast = 0.0;
    return scene;
  });
  for (const ViewDrift& view : report.views) EXPECT_FALSE(view.judged) << view.view;
  EXPECT_THAT(report.sentence, HasSubstr("cannot be told"));
}

TEST(DriftMonitor, JudgesNoViewInWhichAllIsCovered) {
  const DriftReport report = watch([](int view) {
    Scene scene;
    scene.covered = view == 5;
    return scene;
  });
  EXPECT_FALSE(report.views[5].judged);
  EXPECT_TRUE(report.views[6].judged);
  EXPECT_THAT(report.sentence, HasSubstr("In 1 of 8 views it was covered"));
}

TEST(DriftMonitor, JudgesNoPictureOfAnotherSize) {
  DriftMonitor monitor;
  monitor.addFrame(picture({}, 0));
  Frame small;
  small.image_bgr = cv::Mat::zeros(50, 60, CV_8UC3);
  monitor.addFrame(small);
  EXPECT_FALSE(monitor.latest().judged);
  EXPECT_TRUE(DriftMonitor().report().views.empty());
}

TEST(PictureDrift, HoldsTwoPicturesAgainstEachOther) {
  const Frame reference = picture({}, 0);
  EXPECT_NEAR(pictureDrift(reference.image_bgr, picture(shifted(2.0), 3).image_bgr).px, 2.0, 0.04);
  const ViewDrift still = pictureDrift(reference.image_bgr, picture({}, 3).image_bgr);
  EXPECT_TRUE(still.judged);
  EXPECT_FALSE(still.moved);
  Scene covered;
  covered.covered = true;
  EXPECT_FALSE(pictureDrift(reference.image_bgr, picture(covered, 3).image_bgr).judged);
}

}  // namespace
}  // namespace gyre
