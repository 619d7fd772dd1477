// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/acquire.h"

#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/device/streaming_camera.h"
#include "core/pipeline/settling.h"
#include "core/sim/sim_camera.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr int kViews = 6;
constexpr double kSpeed = 50.0;  // simulated seconds a second

const std::shared_ptr<const Renderer>& renderer() {
  static const auto kRenderer = std::make_shared<const Renderer>(atImageWidth(RigSettings{}, 320));
  return kRenderer;
}

// A simulated rig with a wire that can be cut.
class Acquire : public testing::Test {
 protected:
  Acquire() : shaft_(std::make_shared<Shaft>()), firmware_({}, shaft_, SimClock(kSpeed)) {
    auto wire = std::make_unique<FaultyPort>(firmware_.openPort(), Faults{});
    wire_ = wire.get();
    turntable_ = ProtocolTurntable::open(std::move(wire), {}, {}).value();
    auto source = std::make_unique<SimCamera>(renderer(), shaft_, SimClock(kSpeed));
    source->setTable(TableLoad::kObject);
    camera_.emplace(std::move(source));
    ScanSettings settings;
    settings.views = kViews;
    store_.emplace(
        ScanStore::create(folder(), settings, trueCalibration(renderer()->rig())).value());
  }
  std::filesystem::path folder() const { return temp_ / "scan"; }

  Result<void> run(const Task& task = {}) {
    return acquire(
        *turntable_, *camera_, *store_,
        [this](const FramePtr& frame) {
          EXPECT_EQ(store_->views().size(), seen_.size() + 1);  // kept before it is told
          seen_.push_back(frame);
          if (on_view_) on_view_();
        },
        task);
  }

  TempDir temp_;
  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  FaultyPort* wire_ = nullptr;
  std::unique_ptr<Turntable> turntable_;
  std::optional<StreamingCamera> camera_;
  std::optional<ScanStore> store_;
  std::vector<FramePtr> seen_;
  std::function<void()> on_view_;
};

TEST_F(Acquire, UsesWhatWasMeasuredOfThisTurntable) {
  CalibrationRecord record = trueCalibration(renderer()->rig());
  const TurntableInfo info = turntable_->info();
  record.turntable = CalibratedTurntable{info.device_id, info.axis,       info.units_per_turn,
                                         info.direction, radFromDeg(5.0), 0.3};
  ScanSettings settings;
  settings.views = kViews;
  const double usual_rad = turntable_->approachRad();
  double waited_s = 0.0;
  for (const char* device : {"another table", info.device_id.c_str()}) {
    record.turntable->device_id = device;
    store_.emplace(ScanStore::create(temp_ / device, settings, record).value());
    seen_.clear();
    EXPECT_EQ(turntable_->approachRad(), usual_rad);
    const double begin_s = steadySeconds();
    const auto done = run();
    ASSERT_TRUE(done) << done.error().sentence();
    waited_s = steadySeconds() - begin_s;
  }
  EXPECT_GT(turntable_->approachRad(), radFromDeg(5.0));
  EXPECT_GE(waited_s, 0.3 * kViews);
}

TEST_F(Acquire, CapturesAWholeTurnEvenlyAndOnlyAtRest) {
  const auto done = run();
  ASSERT_TRUE(done) << done.error().sentence();
  ASSERT_TRUE(store_->complete());
  ASSERT_EQ(seen_.size(), static_cast<std::size_t>(kViews));
  for (int view = 0; view < kViews; ++view) {
    const CapturedView& kept = store_->views()[static_cast<std::size_t>(view)];
    EXPECT_EQ(kept.steps, std::lround(3200.0 * view / kViews));
    EXPECT_NEAR(kept.table_angle_rad, kTurn_rad * view / kViews, kTurn_rad / 3200.0);
    EXPECT_GT(kept.sharpness, 0.0);
    // The picture is the one of the standing table, to the bit.
    const Frame truth = renderer()->render(kept.steps, TableLoad::kObject);
    const FramePtr read = store_->readView(kept).value();
    EXPECT_EQ(cv::norm(read->image_bgr, truth.image_bgr, cv::NORM_INF), 0.0) << "view " << view;
    EXPECT_EQ(seen_[static_cast<std::size_t>(view)]->view, view);
  }
}

TEST_F(Acquire, KeepsWhatItHasWhenThePortVanishesAndGoesOnLater) {
  on_view_ = [this] {
    if (seen_.size() == 3) wire_->vanish();
  };
  const auto cut = run();
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, Error::Code::kGone);
  EXPECT_EQ(store_->views().size(), 3U);

  store_.reset();  // as the end of the program
  store_.emplace(ScanStore::open(folder()).value());
  turntable_ = ProtocolTurntable::open(firmware_.openPort(), {}, {}).value();
  ASSERT_TRUE(turntable_->setAngle(kTurn_rad * static_cast<double>(shaft_->steps()) / 3200.0));
  on_view_ = nullptr;
  const auto done = run();
  ASSERT_TRUE(done) << done.error().sentence();
  EXPECT_TRUE(store_->complete());
  EXPECT_EQ(seen_.back()->view, kViews - 1);
}

// The camera of the rig, whose focus somebody turns.
class TurnedFocus final : public Camera {
 public:
  explicit TurnedFocus(Camera& camera) : camera_(camera) {}
  Result<FramePtr> grabAfter(double time_s, const Task& task) override {
    return camera_.grabAfter(time_s, task);
  }
  Result<CameraInfo> lockControls() override { return info(); }
  Result<CameraInfo> readControls() override {
    CameraInfo now = info();
    now.controls[0].value = focus;
    return now;
  }
  CameraInfo info() const override {
    CameraInfo info;
    info.controls = {{"focus", true, 35.0, ""}};
    return info;
  }
  double focus = 35.0;

 private:
  Camera& camera_;
};

TEST_F(Acquire, KeepsInTheScanThatTheFocusMoved) {
  TurnedFocus camera(*camera_);
  ScanSettings settings;
  settings.views = kViews;
  settings.camera_controls = camera.info().controls;
  {
    auto store =
        ScanStore::create(temp_ / "turned", settings, trueCalibration(renderer()->rig())).value();
    const auto turn = [&](const FramePtr& frame) {
      if (frame->view == 2) camera.focus = 40.0;
    };
    const auto done = acquire(*turntable_, camera, store, turn, {});
    ASSERT_TRUE(done) << done.error().sentence();
  }
  const auto opened = ScanStore::open(temp_ / "turned");
  ASSERT_TRUE(opened && opened->complete());
  ASSERT_EQ(opened->remarks().size(), 1U);  // looked at in the first view and in the last
  EXPECT_EQ(opened->remarks().front().text, "The camera's focus changed from 35 to 40 at view 6.");
}

TEST_F(Acquire, StopsOnRequestWithEverythingKept) {
  std::stop_source source;
  on_view_ = [&] {
    if (seen_.size() == 2) source.request_stop();
  };
  const auto stopped = run(Task(source.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
  EXPECT_EQ(store_->views().size(), 2U);
}

TEST_F(Acquire, RefusesPicturesOfAnotherSizeThanTheCalibration) {
  Calibration other = trueCalibration(renderer()->rig());
  other.camera.width_px *= 2;
  store_.emplace(ScanStore::create(temp_ / "other", store_->settings(), other).value());
  const auto refused = run();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Error::Code::kInvalidInput);
  EXPECT_NE(refused.error().what.find("320 x 240"), std::string::npos);
  EXPECT_TRUE(store_->views().empty());
}

TEST_F(Acquire, TellsWhichViewItIsAt) {
  std::vector<std::string> stages;
  ASSERT_TRUE(run(Task({}, [&](double, std::string_view stage) { stages.emplace_back(stage); })));
  ASSERT_EQ(stages.size(), static_cast<std::size_t>(kViews) + 1);
  EXPECT_EQ(stages.front(), "View 1 of 6");
  EXPECT_EQ(stages[5], "View 6 of 6");
}

}  // namespace
}  // namespace gyre
