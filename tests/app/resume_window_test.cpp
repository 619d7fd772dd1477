// A scan that was cut off, opened in the window and gone on with, as a person would do it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "app/workbench.h"
#include "core/base/units.h"
#include "core/io/scan_store.h"
#include "core/sim/renderer.h"
#include "tests/support/qt_application.h"
#include "tests/support/temp_dir.h"
#include "ui/device_panel.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 120000;
constexpr int kViews = 24;
constexpr int kCaptured = 6;

RigSettings rig() { return atImageWidth(RigSettings{}, 640); }

class ResumeWindow : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"}) {
      qputenv(name, (dir_ / name).c_str());
    }
    ScanSettings settings;
    settings.views = kViews;
    auto store = ScanStore::create(dir_ / "scan", settings, trueCalibration(rig()));
    ASSERT_TRUE(store.ok());
    const Renderer renderer(rig());
    for (int view = 0; view < kCaptured; ++view) {
      const std::int64_t steps = rig().steps_per_turn * view / kViews;
      Frame frame = renderer.render(steps, TableLoad::kObject);
      frame.view = view;
      frame.table_angle_rad = kTurn_rad * view / kViews;
      ASSERT_TRUE(store->addView(frame, steps));
    }
  }
  void TearDown() override {
    if (!bench_) return;
    QSignalSpy quiet(&controller(), &ScanController::quiet);
    controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(kPatience_ms));
  }
  // The program is started on this rig, the scan is opened and the rig connected.
  void startOn(const RigSettings& sim) {
    RigOptions options;
    options.sim = sim;
    options.sim_speed = 50.0;
    bench_ = std::make_unique<Workbench>(options);
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    panel_ = bench_->window().work_page->scan_panel;
    QSignalSpy notices(&controller(), &ScanController::noticed);
    bench_->open(QString::fromStdString((dir_ / "scan").string()));
    ASSERT_TRUE(notices.wait(kPatience_ms));
    EXPECT_TRUE(notices.front().at(0).toString().contains("6 of 24 views"));
    bench_->window().work_page->device_panel->choose("sim:" + QString::fromStdString(sim.object),
                                                     "sim");
    press(bench_->window().work_page->device_panel, "Connect");
    ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
  }
  ScanController& controller() { return bench_->controller(); }
  bool waitForPhase(ScanPhase phase) {
    return QTest::qWaitFor([&] { return controller().phase() == phase; }, kPatience_ms);
  }
  void press(QWidget* parent, const QString& text) {
    for (auto* button : parent->findChildren<QPushButton*>()) {
      if (button->text() != text) continue;
      ASSERT_TRUE(button->isEnabled() && button->isVisibleTo(parent)) << text.toStdString();
      return button->click();
    }
    ADD_FAILURE() << text.toStdString();
  }
  bool asks() const {
    for (const auto* label : panel_->findChildren<QLabel*>()) {
      if (label->text() == "Does all stand as it stood?") return label->isVisibleTo(panel_);
    }
    return false;
  }
  std::size_t captured() const {
    const auto store = ScanStore::open(dir_ / "scan");
    EXPECT_TRUE(store.ok());
    return store.ok() ? store->views().size() : 0;
  }

  const TempDir dir_;
  std::unique_ptr<Workbench> bench_;
  ScanPanel* panel_ = nullptr;
};

TEST_F(ResumeWindow, GoesOnByItselfWhereAllStandsAsItStood) {
  startOn(rig());
  press(panel_, "Go on with this scan");
  ASSERT_TRUE(waitForPhase(ScanPhase::kDone));
  EXPECT_FALSE(asks());
  EXPECT_EQ(captured(), std::size_t{kViews});
}

TEST_F(ResumeWindow, AsksBeforeItGoesOnWhereThePicturesSayOtherwise) {
  RigSettings pushed = rig();
  pushed.object_offset_mm += 2.0;
  startOn(pushed);
  QSignalSpy objected(&controller(), &ScanController::objected);
  press(panel_, "Go on with this scan");
  QSignalSpy facts(&controller(), &ScanController::factsChanged);
  ASSERT_TRUE(QTest::qWaitFor([&] { return objected.count() == 1; }, kPatience_ms));
  ASSERT_FALSE(facts.isEmpty());
  EXPECT_EQ(facts.back().at(0).value<ScanFacts>().views_done, kCaptured);
  EXPECT_EQ(facts.back().at(0).value<ScanFacts>().views, kViews);
  EXPECT_EQ(controller().phase(), ScanPhase::kFailed);
  EXPECT_TRUE(asks());
  EXPECT_EQ(bench_->window().work_page->shownStep(), Step::kScan);
  EXPECT_EQ(captured(), std::size_t{kCaptured});
  press(panel_, "Do not go on");
  EXPECT_FALSE(asks());
  press(panel_, "Go on with this scan");  // it asks again
  ASSERT_TRUE(QTest::qWaitFor([&] { return objected.count() == 2; }, kPatience_ms));
  press(panel_, "Go on anyway");
  ASSERT_TRUE(waitForPhase(ScanPhase::kDone));
  EXPECT_FALSE(asks());
  EXPECT_EQ(objected.count(), 2);
  EXPECT_EQ(captured(), std::size_t{kViews});
}

}  // namespace
}  // namespace gyre
