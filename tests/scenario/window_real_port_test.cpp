// New scan in the window over a serial port and a network camera, as on real devices: the port is a
// pseudo terminal with the simulated firmware behind it, the camera an HTTP server on loopback.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include <QFile>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "app/workbench.h"
#include "core/io/calibration_file.h"
#include "core/io/scan_store.h"
#include "core/sim/renderer.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/mjpeg_server.h"
#include "tests/support/needs_pty.h"
#include "tests/support/pty_port.h"
#include "tests/support/qt_application.h"
#include "ui/banner.h"
#include "ui/calibration_panel.h"
#include "ui/device_panel.h"
#include "ui/job_bar.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

const auto* const kNeedsPty = testing::AddGlobalTestEnvironment(new test::NeedsPty);

constexpr int kPatience_ms = 120000;
constexpr int kViews = 12;

// What stands on the desk: the program reaches it by port and network only.
class Desk {
 public:
  explicit Desk(const TurntableFirmwareOptions& board = {})
      : shaft_(std::make_shared<Shaft>()),
        firmware_(board, shaft_, SimClock(20.0)),
        renderer_(atImageWidth(RigSettings{}, 320)),
        camera_([this](int) { return renderer_.render(shaft_->steps(), load_).image_bgr; }, 15.0) {
    auto device = PtyPort::make();
    port_ = device->path();
    device->onOpened([this] { firmware_.pressReset(); });
    firmware_.attach(std::move(device));
  }
  void put(TableLoad load) { load_ = load; }
  const std::string& port() const { return port_; }
  std::string cameraUrl() const { return camera_.url(); }
  const Renderer& renderer() const { return renderer_; }
  const Shaft& shaft() const { return *shaft_; }
  TurntableFirmware& firmware() { return firmware_; }

 private:
  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  Renderer renderer_;
  std::atomic<TableLoad> load_{TableLoad::kEmpty};
  std::string port_;
  test::MjpegServer camera_;
};

class WindowRealPort : public testing::Test {
 protected:
  void SetUp() override {
    qputenv("XDG_CONFIG_HOME", folder_.filePath("config").toUtf8());
    startProgram();
  }
  void TearDown() override { endProgram(); }
  void startProgram() {
    bench_ = std::make_unique<Workbench>(RigOptions{});
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
  }
  void endProgram() {
    QSignalSpy quiet(&controller(), &ScanController::quiet);
    controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(20000));
  }
  ScanController& controller() { return bench_->controller(); }
  WorkPage& page() { return *bench_->window().work_page; }
  bool waitForPhase(ScanPhase phase) {
    return QTest::qWaitFor([&] { return controller().phase() == phase; }, kPatience_ms);
  }
  void press(QWidget* parent, const QString& text) {
    for (QPushButton* button : parent->findChildren<QPushButton*>()) {
      if (button->text() != text) continue;
      ASSERT_TRUE(button->isEnabled()) << text.toStdString();
      button->click();
      return;
    }
    FAIL() << "no button " << text.toStdString();
  }
  void connectDevices() {
    Q_EMIT bench_->window().newScanRequested();
    QTest::qWait(200);
    page().device_panel->choose(QString::fromStdString(desk_.port()),
                                QString::fromStdString(desk_.cameraUrl()));
    press(page().device_panel, "Connect");
    ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
  }
  void openCalibration() {
    const std::filesystem::path calibration = folder_.filePath("calibration.json").toStdString();
    ASSERT_TRUE(writeCalibration(calibration, trueCalibration(desk_.renderer().rig())));
    Q_EMIT page().calibration_panel->fileChosen(QString::fromStdString(calibration.string()));
  }
  void startScan() {
    openCalibration();
    press(page().device_panel, "Yes, it may turn");
    press(page().place_panel, "Take the picture");
    ASSERT_TRUE(QTest::qWaitFor([&] { return controller().hasEmptyTable(); }, kPatience_ms));
    desk_.put(TableLoad::kObject);
    press(page().place_panel, "The object is in place");
    page().scan_panel->setViews(kViews);
    page().scan_panel->setFolder(folder_.filePath("scan"));
    ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
    press(page().job_bar, "Start");
    ASSERT_TRUE(waitForPhase(ScanPhase::kScanning));
  }

  explicit WindowRealPort(const TurntableFirmwareOptions& board = {}) : desk_(board) {}

  Desk desk_;
  QTemporaryDir folder_;
  std::unique_ptr<Workbench> bench_;
};

// Its board is locked after each start.
class WindowLockedPort : public WindowRealPort {
 protected:
  WindowLockedPort() : WindowRealPort(lockedBoard()) {}
  static TurntableFirmwareOptions lockedBoard() {
    TurntableFirmwareOptions board;
    board.homing = true;
    return board;
  }
};

TEST_F(WindowLockedPort, IsUnlockedOnlyWhenTheQuestionIsAnswered) {
  connectDevices();
  press(page().device_panel, "Yes, it may turn");
  QSignalSpy failed(&controller(), &ScanController::failed);
  Q_EMIT page().device_panel->turnRequestedDeg(9.0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() == 1; }, kPatience_ms));
  EXPECT_EQ(failed.front().at(0).value<Error>().code, Error::Code::kNoPermission);
  EXPECT_EQ(desk_.shaft().steps(), 0);
  press(page().device_panel, "Unlock it");
  Q_EMIT page().device_panel->turnRequestedDeg(9.0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return desk_.shaft().steps() == 80; }, kPatience_ms));
  EXPECT_EQ(failed.count(), 1);
}

TEST_F(WindowRealPort, MovesNothingBeforeTheUserSaysItIsATurntable) {
  connectDevices();
  EXPECT_FALSE(controller().devices().mayMove());
  QSignalSpy failed(&controller(), &ScanController::failed);
  Q_EMIT page().device_panel->turnRequestedDeg(10.0);
  QTest::qWait(1000);
  EXPECT_EQ(failed.count(), 1);
  EXPECT_EQ(desk_.shaft().steps(), 0);
}

TEST_F(WindowRealPort, CapturesEveryView) {
  connectDevices();
  startScan();
  ASSERT_TRUE(waitForPhase(ScanPhase::kDone));
  const auto store = ScanStore::open(folder_.filePath("scan").toStdString());
  ASSERT_TRUE(store.ok()) << store.error().sentence();
  EXPECT_TRUE(store->complete());
  EXPECT_TRUE(QFile::exists(folder_.filePath("scan/wire.log")));
}

TEST_F(WindowRealPort, UsesTheCalibrationAgainWhenTheSameRigIsConnected) {
  connectDevices();
  EXPECT_FALSE(controller().calibration().has_value());
  openCalibration();
  endProgram();
  startProgram();
  connectDevices();
  ASSERT_TRUE(controller().calibration().has_value());
  EXPECT_EQ(controller().calibration()->calibration.camera.fx, desk_.renderer().rig().focal_px);
}

TEST_F(WindowRealPort, KeepsTheViewsAndSaysSoWhenTheCableIsPulled) {
  connectDevices();
  startScan();
  QSignalSpy facts(&controller(), &ScanController::factsChanged);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !facts.isEmpty() && facts.back().at(0).value<ScanFacts>().views_done >= 2; },
      kPatience_ms));
  desk_.firmware().pullCable();
  ASSERT_TRUE(waitForPhase(ScanPhase::kFailed));
  EXPECT_TRUE(page().banner->isVisible());
  const auto store = ScanStore::open(folder_.filePath("scan").toStdString());
  ASSERT_TRUE(store.ok()) << store.error().sentence();
  EXPECT_GE(store->views().size(), 2U);
  EXPECT_FALSE(store->complete());
}

}  // namespace
}  // namespace gyre
