// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/calibrate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"
#include "tests/support/watched_target.h"

namespace gyre {
namespace {

using test::BlankCamera;
using test::OddTable;
using test::wedge;
using test::World;
using testing::HasSubstr;

// 24 rotations of 32 points at 0.05 px: the verdict's own ± 0.04 mm on 80 mm is 1.2 px of 2400, and
// this is three times that.
constexpr double kFocal_px = 3.6;

CalibrateOptions exactTarget() {
  CalibrateOptions options;
  options.bundle.shape = TargetShape::kExact;
  options.bundle.caliper_sigma_mm = 0.05;
  return options;
}

// A rig whose finder knows the truth, on a table of any ratio.
struct LiveWorld {
  explicit LiveWorld(double ratio) : table([ratio](double told_rad) { return ratio * told_rad; }) {
    world.angle_rad = [this] { return table.trueAngleRad(); };
    sought.target = wedge();
    sought.find = [this](const cv::Mat&) { return world.look(); };
  }

  Result<CalibrationOutcome> calibrate(const CalibrateOptions& options,
                                       const CalibrationWatcher& watcher = {},
                                       const Task& task = {}) {
    return calibrateLive({table, camera}, sought, options, watcher, task);
  }

  OddTable table;
  BlankCamera camera;
  World world;
  SoughtTarget sought;
};

class CalibrateLiveRatio : public testing::TestWithParam<double> {};

TEST_P(CalibrateLiveRatio, MeasuresTheRigAndPutsTheTableRight) {
  LiveWorld rig(GetParam());
  const auto outcome = rig.calibrate(exactTarget());
  ASSERT_TRUE(outcome) << outcome.error().sentence();
  const CameraModel truth = trueCalibration({}).camera;
  EXPECT_NEAR(outcome->rig.calibration.camera.fx, truth.fx, kFocal_px);
  EXPECT_EQ(outcome->views.size(), 24U);
  EXPECT_TRUE(outcome->skipped.empty());
  ASSERT_TRUE(outcome->turntable);
  EXPECT_EQ(outcome->turntable->device_id, "an odd table");
  EXPECT_NEAR(outcome->turntable->units_per_turn, 360.0 / std::abs(GetParam()),
              1e-3 * 360.0 / std::abs(GetParam()));
  EXPECT_EQ(outcome->turntable->direction, GetParam() < 0.0 ? -1 : 1);

  // A radian told is a radian turned now.
  const double before_rad = rig.table.trueAngleRad();
  ASSERT_TRUE(rig.table.moveTo(rig.table.angleRad() + 1.0, {}));
  EXPECT_NEAR(rig.table.trueAngleRad() - before_rad, 1.0, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Ratios, CalibrateLiveRatio, testing::Values(1.0, 2.0, -1.0, -28.0, 0.02));

// A table that swings out after each move: a stripe in the picture does, for so long.
class RingingCamera final : public Camera {
 public:
  RingingCamera(const OddTable& table, double ringing_s) : table_(table), ringing_s_(ringing_s) {}
  Result<FramePtr> grabAfter(double time_s, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    if (table_.angleRad() != angle_rad_) arrived_s_ = time_s;
    angle_rad_ = table_.angleRad();
    Frame frame;
    frame.time_s = time_s + 0.05;
    const double since_s = frame.time_s - arrived_s_;
    const bool rings = since_s < ringing_s_;
    frame.image_bgr = cv::Mat::zeros(960, 1280, CV_8UC3);
    const int at_px = 600 + (rings ? static_cast<int>(40.0 * std::sin(60.0 * since_s)) : 0);
    frame.image_bgr.colRange(at_px, at_px + 80).setTo(cv::Scalar::all(200));
    return std::make_shared<const Frame>(frame);
  }
  Result<CameraInfo> lockControls() override { return CameraInfo{}; }
  CameraInfo info() const override { return {}; }

 private:
  const OddTable& table_;
  double ringing_s_;
  double angle_rad_ = -1.0;
  double arrived_s_ = 0.0;
};

TEST(CalibrateLive, MeasuresHowLongTheTableTakesToSettle) {
  for (const double ringing_s : {0.0, 0.6}) {
    LiveWorld rig(1.0);
    RingingCamera camera(rig.table, ringing_s);
    const auto outcome =
        calibrateLive({rig.table, camera}, rig.sought, exactTarget(), CalibrationWatcher{}, {});
    ASSERT_TRUE(outcome) << outcome.error().sentence();
    // A picture every 50 ms, and a quarter more than was seen, so that nothing is taken too soon.
    EXPECT_GE(outcome->turntable->settle_s, ringing_s);
    EXPECT_LE(outcome->turntable->settle_s, 1.25 * (ringing_s == 0.0 ? 0.0 : ringing_s + 0.1));
    EXPECT_EQ(outcome->turntable->backlash_rad, 0.0);
  }
}

TEST(CalibrateLive, MeasuresThePlayAndReachesEveryPlaceFromOneSide) {
  LiveWorld rig(1.0);
  const double play_rad = radFromDeg(3.0);
  double followed_rad = 0.0;
  OddTable table([&](double told_rad) {
    followed_rad = std::clamp(followed_rad, told_rad, told_rad + play_rad);
    return followed_rad;
  });
  rig.world.angle_rad = [&] { return table.trueAngleRad(); };
  const auto outcome = calibrateLive({table, rig.camera}, rig.sought, exactTarget(), {}, {});
  ASSERT_TRUE(outcome) << outcome.error().sentence();
  EXPECT_NEAR(outcome->turntable->backlash_rad, play_rad, 0.06 * play_rad);
  EXPECT_GT(table.approachRad(), play_rad);
  EXPECT_NEAR(outcome->rig.calibration.camera.fx, trueCalibration({}).camera.fx, kFocal_px);
}

TEST(CalibrateLive, KeepsItsPicturesWithTheirAngles) {
  TempDir temp;
  LiveWorld rig(1.0);
  CalibrateOptions options = exactTarget();
  options.pictures = 12;
  options.keep_pictures = temp / "kept";
  const auto outcome = rig.calibrate(options);
  ASSERT_TRUE(outcome) << outcome.error().sentence();
  const auto pictures = openCalibrationPictures(temp / "kept", temp / "kept" / "angles.csv");
  ASSERT_TRUE(pictures) << pictures.error().sentence();
  ASSERT_EQ(pictures->files.size(), 12U);
  EXPECT_NEAR((*pictures->angles_rad)[3], kTurn_rad / 4.0, 1e-9);
}

TEST(CalibrateLive, TakesAPictureAgainAndThenSkipsIt) {
  LiveWorld rig(1.0);
  rig.sought.find = [&](const cv::Mat&) -> Result<TargetView> {
    const double turned_deg = degFromRad(rig.table.angleRad());
    auto view = rig.world.look();
    const bool hidden = std::abs(turned_deg - 90.0) < 1.0;
    const bool flickers = std::abs(turned_deg - 30.0) < 1.0 && rig.world.pictures % 2 == 0;
    if (!hidden && !flickers) return view;
    return Error{Error::Code::kTooFew, "A hand covers the target.", "Take it away."};
  };
  std::vector<bool> found;
  CalibrationWatcher watcher;
  watcher.on_picture = [&](const SightedPicture& picture) {
    found.push_back(picture.view.has_value());
  };
  const auto outcome = rig.calibrate(exactTarget(), watcher);
  ASSERT_TRUE(outcome) << outcome.error().sentence();
  EXPECT_EQ(found.size(), 24U);
  ASSERT_EQ(outcome->skipped.size(), 1U);
  EXPECT_THAT(outcome->skipped.front(), HasSubstr("007.png: A hand covers"));
}

TEST(CalibrateLive, SaysWhyTheTargetIsSeenInTooFewPictures) {
  LiveWorld rig(1.0);
  bool turning = true;
  rig.sought.find = [&](const cv::Mat&) -> Result<TargetView> {
    if (turning || rig.table.angleRad() < radFromDeg(40.0)) return rig.world.look();
    return Error{Error::Code::kTooFew, "The target is cut off.", "Move it to the middle."};
  };
  CalibrationWatcher watcher;
  watcher.on_picture = [&](const SightedPicture&) { turning = false; };
  const auto outcome = rig.calibrate(exactTarget(), watcher);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Error::Code::kTooFew);
  EXPECT_THAT(outcome.error().what, HasSubstr("only 3 of 24"));
  EXPECT_THAT(outcome.error().advice, HasSubstr("cut off"));
}

TEST(CalibrateLive, StopsTheTableWhenItIsStopped) {
  LiveWorld rig(1.0);
  std::stop_source source;
  CalibrationWatcher watcher;
  watcher.on_picture = [&](const SightedPicture& picture) {
    if (picture.picture == 4) source.request_stop();
  };
  const auto outcome = rig.calibrate(exactTarget(), watcher, Task(source.get_token()));
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Error::Code::kCancelled);
  EXPECT_TRUE(rig.table.stopped);
}

TEST(CalibrateFromPictures, NeedsNoAngles) {
  TempDir temp;
  // The picture's grey value tells the finder which it is.
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(writePicture(temp / ("p" + std::to_string(i) + ".png"),
                             cv::Mat(960, 1280, CV_8UC3, cv::Scalar::all(10 * i))));
  }
  World world;
  SoughtTarget sought;
  sought.target = wedge();
  sought.find = [&](const cv::Mat& image) {
    world.angle_rad = [i = image.at<cv::Vec3b>(0, 0)[0] / 10] { return -kTurn_rad * i / 12.0; };
    return world.look();
  };
  const auto pictures = openCalibrationPictures(temp.path(), {});
  ASSERT_TRUE(pictures) << pictures.error().sentence();
  const auto outcome = calibrateFromPictures(*pictures, sought, exactTarget(), {}, {});
  ASSERT_TRUE(outcome) << outcome.error().sentence();
  EXPECT_NEAR(outcome->rig.calibration.camera.fx, trueCalibration({}).camera.fx, 4.0);
  const CalibrationRecord record = recordOf(*outcome, "2026-01-01T00:00:00Z");
  EXPECT_EQ(record.target, "wedge");
  EXPECT_FALSE(record.turntable);
}

TEST(CalibrateFromPictures, SaysWhenTheFolderHoldsNone) {
  TempDir temp;
  EXPECT_FALSE(openCalibrationPictures(temp / "nowhere", {}));
  EXPECT_FALSE(openCalibrationPictures(temp.path(), {}));
}

}  // namespace
}  // namespace gyre
