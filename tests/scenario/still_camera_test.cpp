// A whole turn with a still camera on the network, real libgphoto2 between. The turntable is the
// simulated one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "app/rig.h"
#include "core/device/whole_jpeg.h"
#include "core/io/scan_store.h"
#include "core/pipeline/acquire.h"
#include "core/sim/rig.h"
#include "tests/support/ptpip_camera.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr int kViews = 8;

RigOptions options() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 320);
  options.sim_speed = 20.0;
  return options;
}

test::Bytes jpegOf(const cv::Mat& picture) {
  test::Bytes bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 98});
  return bytes;
}

// A camera that looks at the simulated table and is fired over PTP/IP.
class StillCamera : public testing::Test {
 protected:
  StillCamera()
      : renderer_(options().sim), device_([this](int) {
          return jpegOf(renderer_.render(shaft_->steps(), TableLoad::kObject).image_bgr);
        }) {
    setenv("HOME", home_.path().c_str(), 1);  // libgphoto2 keeps its settings there
    auto rig = openRig("sim", device_.word(), options(), {});
    EXPECT_TRUE(rig) << rig.error().sentence();
    rig_ = std::move(rig).value();
    shaft_ = rig_.room->shaft;
    ScanSettings settings;
    settings.views = kViews;
    settings.camera_controls = rig_.camera->lockControls().value().controls;
    store_.emplace(
        ScanStore::create(home_ / "scan", settings, trueCalibration(options().sim)).value());
  }

  Result<void> capture(const std::function<void(int view)>& on_view) {
    return acquire(*rig_.turntable, *rig_.camera, *store_,
                   [&](const FramePtr& frame) { on_view(frame->view); }, {});
  }
  void expectEveryViewAsItWas() {
    ASSERT_TRUE(store_->complete());
    for (const CapturedView& view : store_->views()) {
      const Frame truth = renderer_.render(view.steps, TableLoad::kObject);
      const cv::Mat sent = decodeWholeJpeg(jpegOf(truth.image_bgr)).value();
      EXPECT_EQ(cv::norm(store_->readView(view).value()->image_bgr, sent, cv::NORM_INF), 0.0)
          << "view " << view.view;
    }
  }

  TempDir home_;
  Renderer renderer_;
  std::shared_ptr<Shaft> shaft_;
  test::PtpIpCamera device_;
  Rig rig_;
  std::optional<ScanStore> store_;
};

TEST_F(StillCamera, TakesEveryViewAtRestAndLeavesNothingOnTheCard) {
  const auto captured = capture([](int) {});
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
  EXPECT_EQ(device_.filesLeft(), 0);
  EXPECT_LE(device_.shots(), 2 * kViews) << "shutters wear out";
}

TEST_F(StillCamera, LosesNoViewWhenItFallsAsleepAndIsWokenUp) {
  const auto cut = capture([this](int view) {
    if (view == 3) device_.vanish();
  });
  ASSERT_FALSE(cut);
  EXPECT_FALSE(cut.error().advice.empty());
  EXPECT_EQ(store_->views().size(), 4U);
  device_.comeBack();
  Result<void> captured = capture([](int) {});
  for (int i = 0; i < 3 && !captured; ++i) captured = capture([](int) {});
  ASSERT_TRUE(captured) << captured.error().sentence();
  expectEveryViewAsItWas();
}

}  // namespace
}  // namespace gyre
