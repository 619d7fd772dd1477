// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/settling.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"

namespace gyre {
namespace {

// A still room with a textured square of a tenth of the picture in it, moved right by shift_px.
cv::Mat scene(double shift_px, double noise, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(480, 640, CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const bool object = std::abs(u - 320 - shift_px) < 90 && std::abs(v - 240) < 90;
      const double x = object ? (u - shift_px) * 0.7 : u * 0.3;
      const double grey = 128 + 60 * std::sin(x) * std::cos(0.4 * v) + noise * random.gaussian();
      image.at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<uchar>(grey));
    }
  }
  return image;
}

TEST(SomethingMoved, SeesAShiftOfHalfAPixelThroughNoise) {
  EXPECT_TRUE(somethingMoved(scene(0.0, 2.0, 1), scene(0.5, 2.0, 2)));
  EXPECT_TRUE(somethingMoved(scene(0.0, 2.0, 1), scene(3.0, 2.0, 2)));
}

TEST(SomethingMoved, IsNotFooledByNoiseOrByALampThatGrowsBrighter) {
  for (const double noise : {0.0, 2.0, 8.0}) {
    const cv::Mat after = scene(0.0, noise, 2) + cv::Scalar::all(3);
    EXPECT_FALSE(somethingMoved(scene(0.0, noise, 1), after)) << noise;
  }
}

// Swings until still_after_s past time 0; a picture every 70 ms of its own time.
class SwingingCamera final : public Camera {
 public:
  explicit SwingingCamera(double still_after_s) : still_after_s_(still_after_s) {}
  Result<FramePtr> grabAfter(double time_s, const Task& task) override {
    if (task.stopRequested()) return cancelled();
    Frame frame;
    frame.time_s = time_s + 0.07;
    const double shift_px =
        frame.time_s < still_after_s_ ? 20.0 * std::sin(40.0 * frame.time_s) : 0;
    frame.image_bgr = scene(shift_px, 2.0, ++pictures_);
    return std::make_shared<const Frame>(std::move(frame));
  }
  Result<CameraInfo> lockControls() override { return info(); }
  CameraInfo info() const override { return {}; }

  std::uint64_t pictures_ = 0;

 private:
  double still_after_s_;
};

TEST(Settling, WaitsUntilTheObjectStandsAndLearnsHowLongThatTakes) {
  SwingingCamera camera(0.3);
  Settling settling;
  const auto frame = settling.grabStill(camera, 0.0, {});
  ASSERT_TRUE(frame);
  EXPECT_GE((*frame)->time_s, 0.3);
  EXPECT_GE(settling.delaySeconds(), 0.3);
  EXPECT_LT(settling.delaySeconds(), 0.7);
}

TEST(Settling, CostsOnePictureAViewOnceTheTableIsKnownToBeStiff) {
  SwingingCamera camera(0.0);
  Settling settling;
  for (int view = 0; view < 13; ++view) ASSERT_TRUE(settling.grabStill(camera, 1.0, {}));
  EXPECT_EQ(camera.pictures_, 3U * 2U + 10U);
  EXPECT_EQ(settling.delaySeconds(), 0.0);
}

TEST(Settling, FallsBackToAFixedDelayWhereNothingEverComesToRest) {
  SwingingCamera camera(1e9);
  Settling settling;
  ASSERT_TRUE(settling.grabStill(camera, 0.0, {}));
  EXPECT_GT(settling.delaySeconds(), 0.0);
  const std::uint64_t watched = camera.pictures_;
  ASSERT_TRUE(settling.grabStill(camera, 10.0, {}));
  EXPECT_EQ(camera.pictures_, watched + 1);
}

TEST(Settling, WaitsAsLongAsIsKnownBeforeItLooks) {
  SwingingCamera camera(0.3);
  Settling settling(0.4);
  const auto frame = settling.grabStill(camera, 0.0, {});
  ASSERT_TRUE(frame);
  EXPECT_GE((*frame)->time_s, 0.4);
  EXPECT_EQ(camera.pictures_, 2U);  // nothing moved any more
  EXPECT_EQ(settling.delaySeconds(), 0.4);
}

TEST(Settling, LearnsThatItTakesLongerThanWasKnown) {
  SwingingCamera camera(0.9);
  Settling settling(0.4);
  const auto frame = settling.grabStill(camera, 0.0, {});
  ASSERT_TRUE(frame);
  EXPECT_GE((*frame)->time_s, 0.9);
  EXPECT_GE(settling.delaySeconds(), 0.9);
  EXPECT_LT(settling.delaySeconds(), 1.5);
}

TEST(Settling, TakesNoLongerThanTablesSwingWhateverIsSaidToBeKnown) {
  EXPECT_EQ(Settling(1e9).delaySeconds(), 2.5);
  EXPECT_EQ(Settling(-1.0).delaySeconds(), 0.0);
}

TEST(Settling, HandsOnThatItWasStopped) {
  SwingingCamera camera(1e9);
  std::stop_source source;
  source.request_stop();
  const auto frame = Settling().grabStill(camera, 0.0, Task(source.get_token()));
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
