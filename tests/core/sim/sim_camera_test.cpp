// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sim_camera.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

RigSettings tinyRig() {
  RigSettings rig = atImageWidth({}, 160);
  rig.noise_sigma = 0.0;
  return rig;
}

std::shared_ptr<const Renderer> sharedRenderer() {
  static const auto kRenderer = std::make_shared<const Renderer>(tinyRig());
  return kRenderer;
}

// A camera at twenty times the speed: 600 pictures a second.
struct Bench {
  std::shared_ptr<const Renderer> renderer = sharedRenderer();
  std::shared_ptr<Shaft> shaft = std::make_shared<Shaft>();
  SimCamera camera{renderer, shaft, SimClock(20.0)};

  bool nextShows(std::int64_t steps, TableLoad load) {
    if (!camera.grab(1.0)) return false;
    const auto frame = camera.retrieve();
    if (!frame) return false;
    const cv::Mat expected = renderer->render(steps, load).image_bgr;
    return std::equal(expected.datastart, expected.dataend, frame->image_bgr.data);
  }
};

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(100)); }

TEST(SimCamera, GivesFourStalePicturesAfterAPause) {
  Bench bench;
  pause();
  bench.shaft->setSteps(300);
  bench.camera.setTable(TableLoad::kObject);
  pause();
  for (std::size_t i = 0; i < SimCamera::kQueueLength; ++i) {
    EXPECT_TRUE(bench.nextShows(0, TableLoad::kEmpty)) << i;
  }
  EXPECT_TRUE(bench.nextShows(300, TableLoad::kObject));
}

TEST(SimCamera, TimeIsTheMomentOfTheGrab) {
  Bench bench;
  pause();
  const double before_s = steadySeconds();
  ASSERT_TRUE(bench.camera.grab(1.0).ok());
  const double after_s = steadySeconds();
  pause();
  const auto frame = bench.camera.retrieve();
  ASSERT_TRUE(frame.ok());
  EXPECT_GE(frame->time_s, before_s);
  EXPECT_LE(frame->time_s, after_s);
  EXPECT_EQ(frame->view, -1);
}

TEST(SimCamera, RetrieveWithoutGrabIsAnError) {
  Bench bench;
  EXPECT_FALSE(bench.camera.retrieve().ok());
}

TEST(SimCamera, TimesOutWhenAPictureTakesLonger) {
  SimCamera slow(sharedRenderer(), std::make_shared<Shaft>(), SimClock(0.001));
  const auto grabbed = slow.grab(0.02);
  ASSERT_FALSE(grabbed.ok());
  EXPECT_EQ(grabbed.error().code, Error::Code::kTimeout);
}

TEST(SimCamera, ReportsEverythingLocked) {
  Bench bench;
  const CameraInfo info = bench.camera.lockControls();
  EXPECT_EQ(info.width_px, 160);
  EXPECT_EQ(info.controls.size(), 4U);
  for (const ControlState& control : info.controls) EXPECT_TRUE(control.locked);
}

TEST(SimCamera, PicturesAreTheCallersOwn) {
  Bench bench;
  ASSERT_TRUE(bench.camera.grab(1.0).ok());
  auto first = bench.camera.retrieve();
  ASSERT_TRUE(first.ok());
  first->image_bgr.setTo(0);
  EXPECT_TRUE(bench.nextShows(0, TableLoad::kEmpty));
}

}  // namespace
}  // namespace gyre
