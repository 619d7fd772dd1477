// Whole scans with a network camera that stalls, drops its connection, sends half a picture, turns
// its pictures and comes back. The turntable is the simulated one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "app/rig.h"
#include "core/device/whole_jpeg.h"
#include "core/io/scan_store.h"
#include "core/pipeline/acquire.h"
#include "core/sim/rig.h"
#include "tests/support/mjpeg_server.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr int kViews = 12;

RigOptions options() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 320);
  options.sim_speed = 20.0;
  return options;
}

// A camera on the network that looks at the simulated table.
class NetworkCamera : public testing::Test {
 protected:
  NetworkCamera()
      : renderer_(options().sim),
        server_(
            [this](int) -> cv::Mat {
              const std::int64_t steps = steps_ ? steps_->steps() : 0;
              const cv::Mat upright = renderer_.render(steps, TableLoad::kObject).image_bgr;
              return turned_ ? cv::Mat(upright.t()) : upright;
            },
            15.0) {
    auto rig = openRig("sim", server_.url(), options(), {});
    EXPECT_TRUE(rig) << rig.error().sentence();
    rig_ = std::move(rig).value();
    steps_ = rig_.room->shaft;
    ScanSettings settings;
    settings.views = kViews;
    store_.emplace(
        ScanStore::create(dir_ / "scan", settings, trueCalibration(options().sim)).value());
  }

  // Captures what is missing; `trouble` comes when the view is safe on the disk.
  Result<void> capture(int view, const std::function<void()>& trouble) {
    return acquire(*rig_.turntable, *rig_.camera, *store_,
                   [&](const FramePtr& frame) {
                     if (frame->view == view) trouble();
                   },
                   {});
  }
  void expectEveryViewAsItWas() {
    ASSERT_TRUE(store_->complete());
    for (const CapturedView& view : store_->views()) {
      // What the camera sends of the table where it truly stands, to the bit.
      const Frame truth = renderer_.render(view.steps, TableLoad::kObject);
      const cv::Mat sent = decodeWholeJpeg(test::jpegOf(truth.image_bgr)).value();
      EXPECT_EQ(cv::norm(store_->readView(view).value()->image_bgr, sent, cv::NORM_INF), 0.0)
          << "view " << view.view;
    }
  }

  TempDir dir_;
  Renderer renderer_;
  std::shared_ptr<Shaft> steps_;
  std::atomic<bool> turned_{false};
  test::MjpegServer server_;
  Rig rig_;
  std::optional<ScanStore> store_;
};

TEST_F(NetworkCamera, LosesNoViewToADroppedConnectionAndHalfPictures) {
  const auto captured = capture(3, [this] {
    server_.drop();
    server_.tear(5);
  });
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
  EXPECT_GT(server_.clients(), 1);
}

TEST_F(NetworkCamera, WaitsForACameraThatComesBackAndSaysSo) {
  std::jthread mender;
  const auto captured = capture(4, [&] {
    server_.freeze();
    mender = std::jthread([this] {
      std::this_thread::sleep_for(std::chrono::seconds(8));
      server_.thaw();
    });
  });
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
  ASSERT_EQ(store_->remarks().size(), 1U);
  EXPECT_THAT(store_->remarks().front().text, HasSubstr("kept view 6 waiting for"));
  EXPECT_EQ(store_->remarks().front().view, 5);
}

TEST_F(NetworkCamera, IsNamedWhenItSendsAnotherSizeAndGoesOnWhenItIsTurnedBack) {
  const auto refused = capture(2, [this] { turned_ = true; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Error::Code::kInvalidInput);
  EXPECT_THAT(refused.error().what, HasSubstr("The camera's pictures have"));
  EXPECT_EQ(store_->views().size(), 3U);
  turned_ = false;
  const auto captured = capture(-1, [] {});
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
}

TEST_F(NetworkCamera, ThatStaysAwayEndsTheScanInTimeWithAllItHas) {
  const double patience_s = 45.0;
  const auto start = std::chrono::steady_clock::now();
  const auto ended = capture(5, [this] { server_.vanish(); });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, Error::Code::kTimeout);
  EXPECT_THAT(ended.error().sentence(), HasSubstr("sends no pictures any more"));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            patience_s);
  EXPECT_EQ(store_->views().size(), 6U);
  server_.comeBack();
  const auto captured = capture(-1, [] {});
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
}

}  // namespace
}  // namespace gyre
