// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/streaming_camera.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

using namespace std::chrono_literals;

// What a test does to the source while the camera's thread reads it, and what it hears of it.
struct Script {
  std::atomic<double> interval_s{0.004};
  std::atomic<double> decode_s{0.0};
  std::atomic<bool> gone{false};
  std::atomic<bool> silent{false};
  std::atomic<bool> broken{false};
  std::atomic<bool> tells_empty{true};
  std::atomic<int> decoded{0};
  std::atomic<int> locks{0};
};

// Exposes a picture every interval and queues it; drops new ones while four wait, as V4L2 does.
// The moment of exposure is the frame's table angle: the camera under test cannot know it.
class QueueingSource final : public FrameSource {
 public:
  explicit QueueingSource(Script& script) : script_(script), next_s_(steadySeconds()) {}

  Result<void> grab(double timeout_s) override {
    const double deadline_s = steadySeconds() + (script_.tells_empty ? timeout_s : 1e3);
    while (true) {
      if (script_.gone) return Error{Error::Code::kGone, "Pulled out.", ""};
      expose();
      if (!queue_.empty()) {
        taken_s_ = queue_.front();
        queue_.pop_front();
        return {};
      }
      if (steadySeconds() >= deadline_s) return Error{Error::Code::kTimeout, "None.", ""};
      std::this_thread::sleep_for(200us);
    }
  }

  Result<Frame> retrieve() override {
    ++script_.decoded;
    std::this_thread::sleep_for(std::chrono::duration<double>(script_.decode_s.load()));
    if (script_.broken) return Error{Error::Code::kIo, "Torn.", ""};
    Frame frame;
    frame.time_s = steadySeconds();
    frame.table_angle_rad = taken_s_;
    frame.image_bgr = cv::Mat(2, 2, CV_8UC3);
    return frame;
  }

  CameraInfo lockControls() override {
    ++script_.locks;
    CameraInfo locked = info();
    locked.controls = {{"focus", true, 7.0, ""}};
    return locked;
  }
  CameraInfo info() const override {
    CameraInfo info;
    info.description = "scripted";
    return info;
  }
  bool tellsEmptyQueue() const override { return script_.tells_empty; }

 private:
  void expose() {
    while (!script_.silent && next_s_ <= steadySeconds()) {
      if (queue_.size() < 4) queue_.push_back(next_s_ - script_.interval_s);
      next_s_ += script_.interval_s;
    }
  }

  Script& script_;
  std::deque<double> queue_;  // when the exposures began
  double next_s_;
  double taken_s_ = 0.0;
};

StreamingCameraOptions impatient() {
  StreamingCameraOptions options;
  options.silence_s = 0.2;
  options.patience_s = 0.6;
  return options;
}

// Waits before each request, so that pictures pile up wherever nobody reads.
void expectFresh(Camera& camera, int count) {
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(7ms);
    const double asked_s = steadySeconds();
    const auto frame = camera.grabAfter(asked_s, {});
    ASSERT_TRUE(frame) << frame.error().sentence();
    EXPECT_GE((*frame)->table_angle_rad, asked_s);
  }
}

TEST(StreamingCamera, GivesOnlyPicturesExposedAfterTheMoment) {
  Script script;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  expectFresh(camera, 20);
}

TEST(StreamingCamera, IsNotFooledByWhatPilesUpWhileAPictureIsDecoded) {
  Script script;
  script.decode_s = 0.03;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  std::atomic<bool> done{false};
  std::jthread preview([&] {
    while (!done) (void)camera.grabAfter(steadySeconds() - 0.1, {});
  });
  expectFresh(camera, 8);
  done = true;
}

TEST(StreamingCamera, JudgesByTheWaitWhereTheDriverCannotTell) {
  Script script;
  script.tells_empty = false;
  script.interval_s = 0.02;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  expectFresh(camera, 6);
}

TEST(StreamingCamera, AllowsForTheTimeOnTheWay) {
  Script script;
  StreamingCameraOptions options;
  options.transport_delay_s = 0.05;
  StreamingCamera camera(std::make_unique<QueueingSource>(script), options);
  const double asked_s = steadySeconds();
  const auto frame = camera.grabAfter(asked_s, {});
  ASSERT_TRUE(frame);
  EXPECT_GE((*frame)->table_angle_rad, asked_s + 0.05);
}

TEST(StreamingCamera, DecodesOnlyWhileSomebodyWaits) {
  Script script;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(script.decoded, 0);
  ASSERT_TRUE(camera.grabAfter(steadySeconds(), {}));
  EXPECT_EQ(script.decoded, 1);
}

TEST(StreamingCamera, OnePictureServesAllWhoWait) {
  Script script;
  script.interval_s = 0.05;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  const double asked_s = steadySeconds();
  std::vector<FramePtr> got(3);
  {
    std::vector<std::jthread> waiting;
    for (FramePtr& frame : got) {
      waiting.emplace_back([&] { frame = camera.grabAfter(asked_s, {}).value(); });
    }
  }
  EXPECT_EQ(got[0], got[1]);
  EXPECT_EQ(got[0], got[2]);
  EXPECT_EQ(script.decoded, 1);
}

TEST(StreamingCamera, ReportsSilenceAndRecoversFromIt) {
  Script script;
  script.silent = true;
  StreamingCamera camera(std::make_unique<QueueingSource>(script), impatient());
  const auto nothing = camera.grabAfter(steadySeconds(), {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Error::Code::kTimeout);
  EXPECT_FALSE(nothing.error().advice.empty());
  script.silent = false;
  EXPECT_TRUE(camera.grabAfter(steadySeconds(), {}));
}

TEST(StreamingCamera, ReportsAVanishedCameraToThoseWhoWaitAndLater) {
  Script script;
  script.silent = true;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  std::jthread puller([&] {
    std::this_thread::sleep_for(20ms);
    script.gone = true;
  });
  for (int i = 0; i < 2; ++i) {
    const auto nothing = camera.grabAfter(steadySeconds(), {});
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, Error::Code::kGone);
  }
  EXPECT_EQ(camera.lockControls().error().code, Error::Code::kGone);
}

TEST(StreamingCamera, SkipsBrokenPicturesUntilThereAreTooMany) {
  Script script;
  script.interval_s = 0.001;
  script.broken = true;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  const auto nothing = camera.grabAfter(steadySeconds(), {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Error::Code::kIo);
  EXPECT_GT(script.decoded, 10);
}

TEST(StreamingCamera, StopsWaitingOnRequest) {
  Script script;
  script.silent = true;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  std::stop_source source;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(20ms);
    source.request_stop();
  });
  const auto nothing = camera.grabAfter(steadySeconds(), Task(source.get_token()));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Error::Code::kCancelled);
}

TEST(StreamingCamera, LocksControlsInItsOwnThreadAndKeepsWhatIsReadBack) {
  Script script;
  StreamingCamera camera(std::make_unique<QueueingSource>(script));
  EXPECT_TRUE(camera.info().controls.empty());
  const auto locked = camera.lockControls();
  ASSERT_TRUE(locked);
  EXPECT_EQ(locked->controls.at(0).value, 7.0);
  EXPECT_EQ(camera.info().controls.size(), 1U);
  EXPECT_EQ(script.locks, 1);
}

}  // namespace
}  // namespace gyre
