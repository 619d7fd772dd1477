// A scan in the window on a table that a person turns, with a camera on the network.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <string>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>

#include "app/workbench.h"
#include "core/base/units.h"
#include "core/io/calibration_file.h"
#include "core/io/scan_store.h"
#include "core/sim/renderer.h"
#include "tests/support/mjpeg_server.h"
#include "tests/support/qt_application.h"
#include "tests/support/temp_dir.h"
#include "ui/calibration_panel.h"
#include "ui/device_panel.h"
#include "ui/hand_card.h"
#include "ui/job_bar.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 120000;
constexpr int kMarks = 12;

class HandWindow : public testing::Test {
 protected:
  HandWindow()
      : renderer_(atImageWidth(RigSettings{}, 320)),
        camera_([this](int) { return renderer_.render(steps_, load_).image_bgr; }, 15.0) {}
  void SetUp() override {
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"}) {
      qputenv(name, (dir_ / name).c_str());
    }
    bench_ = std::make_unique<Workbench>(RigOptions());
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    card_ = page().hand_card;
    Q_EMIT bench_->window().newScanRequested();
    QTest::qWait(200);
    page().device_panel->choose("hand:" + QString::number(kMarks),
                                QString::fromStdString(camera_.url()));
    press(page().device_panel, "Connect");
    ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
    const auto calibration = dir_ / "calibration.json";
    ASSERT_TRUE(writeCalibration(calibration, trueCalibration(renderer_.rig())));
    Q_EMIT page().calibration_panel->fileChosen(QString::fromStdString(calibration.string()));
  }
  void TearDown() override {
    QSignalSpy quiet(&controller(), &ScanController::quiet);
    controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(kPatience_ms));
  }
  ScanController& controller() { return bench_->controller(); }
  WorkPage& page() { return *bench_->window().work_page; }
  bool waitForPhase(ScanPhase phase) {
    return QTest::qWaitFor([&] { return controller().phase() == phase; }, kPatience_ms);
  }
  QPushButton* button(QWidget* parent, const QString& text) {
    for (QPushButton* candidate : parent->findChildren<QPushButton*>()) {
      if (candidate->text() == text) return candidate;
    }
    ADD_FAILURE() << text.toStdString();
    return nullptr;
  }
  void press(QWidget* parent, const QString& text) {
    ASSERT_TRUE(button(parent, text)->isEnabled()) << text.toStdString();
    button(parent, text)->click();
  }
  // Turns the table as the card says. [steps of the simulated rig]
  void turn(const HandTurnFacts& turn) {
    const double by = (turn.counter_clockwise ? 1.0 : -1.0) * static_cast<double>(turn.marks) *
                      turn.mark_deg / 360.0;
    steps_ += std::llround(by * renderer_.rig().steps_per_turn);
  }
  void start() {
    press(page().place_panel, "Take the picture");
    ASSERT_TRUE(QTest::qWaitFor([&] { return controller().hasEmptyTable(); }, kPatience_ms));
    load_ = TableLoad::kObject;
    press(page().place_panel, "The object is in place");
    page().scan_panel->setFolder(QString::fromStdString((dir_ / "scan").string()));
    ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
    press(page().job_bar, "Start");
    ASSERT_TRUE(waitForPhase(ScanPhase::kScanning));
  }

  const TempDir dir_;
  std::atomic<std::int64_t> steps_ = 0;
  std::atomic<TableLoad> load_ = TableLoad::kEmpty;
  Renderer renderer_;
  test::MjpegServer camera_;
  std::unique_ptr<Workbench> bench_;
  HandCard* card_ = nullptr;
};

TEST_F(HandWindow, ScansATurnThatAPersonTurnsByButtonAndKey) {
  EXPECT_TRUE(controller().devices().mayMove());  // there is no machine that could move
  EXPECT_EQ(page().scan_panel->views(), kMarks);
  int asked = 0;
  PersonAtWindow& person = bench_->person();
  QObject::connect(&person, &PersonAtWindow::asked, &person, [&](const HandTurnFacts& facts) {
    ++asked;
    turn(facts);
    QTimer::singleShot(10, card_, [this, by_key = asked % 2 == 0] {
      EXPECT_FALSE(card_->isHidden());
      if (by_key) {
        QTest::keyClick(&bench_->window(), Qt::Key_Return);
      } else {
        button(card_, "Done")->click();
      }
    });
  });
  start();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return controller().phase() == ScanPhase::kDone ||
               controller().phase() == ScanPhase::kFailed;
      },
      kPatience_ms));
  EXPECT_GE(asked, kMarks - 1);
  const auto store = ScanStore::open(dir_ / "scan");
  ASSERT_TRUE(store.ok()) << store.error().sentence();
  EXPECT_TRUE(store->complete());
  EXPECT_NEAR(degFromRad(store->views().back().table_angle_rad), 330.0, 1e-9);
}

TEST_F(HandWindow, StopsWhileItAsksAndKeepsTheViews) {
  PersonAtWindow& person = bench_->person();
  int asked = 0;
  QObject::connect(&person, &PersonAtWindow::asked, &person, [&](const HandTurnFacts& facts) {
    if (++asked > 3) return;
    turn(facts);
    QTimer::singleShot(10, card_, [this] { button(card_, "Done")->click(); });
  });
  start();
  ASSERT_TRUE(QTest::qWaitFor([&] { return asked > 3; }, kPatience_ms));
  press(card_, "Stop");
  ASSERT_TRUE(waitForPhase(ScanPhase::kFailed));
  EXPECT_TRUE(QTest::qWaitFor([&] { return card_->isHidden(); }));
  const auto store = ScanStore::open(dir_ / "scan");
  ASSERT_TRUE(store.ok()) << store.error().sentence();
  EXPECT_GE(store->views().size(), 2U);
  EXPECT_FALSE(store->complete());
}

TEST_F(HandWindow, WarnsOfMoreViewsThanMarks) {
  const auto warned = [this] {
    for (const QLabel* label : page().scan_panel->findChildren<QLabel*>()) {
      if (label->text().contains("12 places") && !label->isHidden()) return true;
    }
    return false;
  };
  EXPECT_FALSE(warned());
  page().scan_panel->setViews(72);
  EXPECT_TRUE(warned());
}

}  // namespace
}  // namespace gyre
