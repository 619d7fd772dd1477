// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/watch_motor.h"

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/support/watched_target.h"

namespace gyre {
namespace {

using test::OddTable;
using testing::HasSubstr;

// Sees spokes turn about the middle of the picture, through noise.
class SpokesCamera final : public Camera {
 public:
  explicit SpokesCamera(const OddTable& table) : table_(table) {}
  Result<FramePtr> grabAfter(double time_s, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    Random random(++pictures_);
    const double shake = shaken ? 0.3 * static_cast<double>(pictures_) : 0.0;
    Frame frame;
    frame.time_s = time_s + 0.05;
    frame.image_bgr.create(240, 320, CV_8UC3);
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        const double at_rad = std::atan2(v - 119.5, u - 159.5) - table_.trueAngleRad() + shake;
        const bool on_table = std::hypot(v - 119.5, u - 159.5) < 90.0;
        const double grey = 128 + (on_table ? 80 * std::sin(9.0 * at_rad) : 0.0);
        frame.image_bgr.at<cv::Vec3b>(v, u) =
            cv::Vec3b::all(cv::saturate_cast<uchar>(grey + 2.0 * random.gaussian()));
      }
    }
    return std::make_shared<const Frame>(frame);
  }
  Result<CameraInfo> lockControls() override { return CameraInfo{}; }
  CameraInfo info() const override { return {}; }

  bool shaken = false;

 private:
  const OddTable& table_;
  std::uint64_t pictures_ = 0;
};

class WatchMotorRatio : public testing::TestWithParam<double> {};

TEST_P(WatchMotorRatio, SeesATableTurnAndLeavesItWhereItWas) {
  double farthest_rad = 0.0;
  OddTable table([&](double told_rad) {
    farthest_rad = std::max(farthest_rad, std::abs(GetParam() * told_rad));
    return GetParam() * told_rad;
  });
  SpokesCamera camera(table);
  const auto seen = watchMotor(table, camera, {});
  ASSERT_TRUE(seen) << seen.error().sentence();
  EXPECT_TRUE(seen->turns);
  EXPECT_EQ(table.angleRad(), 0.0);
  EXPECT_LE(farthest_rad, radFromDeg(20.0));
}
INSTANTIATE_TEST_SUITE_P(FromATenthToFifty, WatchMotorRatio,
                         testing::Values(0.1, -0.5, 1.0, 4.0, -28.0, 50.0));

TEST(WatchMotor, SeesThatAMotorStands) {
  OddTable table([](double) { return 0.0; });
  SpokesCamera camera(table);
  const auto seen = watchMotor(table, camera, {});
  ASSERT_TRUE(seen) << seen.error().sentence();
  EXPECT_FALSE(seen->turns);
  EXPECT_GE(seen->told_rad, radFromDeg(51.0));
  const Error said = motorStands(seen->told_rad);
  EXPECT_THAT(said.what, HasSubstr("the camera sees nothing move"));
  EXPECT_THAT(said.advice, HasSubstr("power"));
}

TEST(WatchMotor, CanTellNothingOfAPictureThatMovesByItself) {
  OddTable table([](double) { return 0.0; });
  SpokesCamera camera(table);
  camera.shaken = true;
  const auto seen = watchMotor(table, camera, {});
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().what, HasSubstr("though the table stands"));
  EXPECT_EQ(table.angleRad(), 0.0);
}

TEST(WatchMotor, StopsOnRequest) {
  OddTable table([](double told_rad) { return told_rad; });
  SpokesCamera camera(table);
  std::stop_source source;
  source.request_stop();
  const auto seen = watchMotor(table, camera, Task(source.get_token()));
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.error().code, Error::Code::kCancelled);
  EXPECT_TRUE(table.stopped);
}

}  // namespace
}  // namespace gyre
