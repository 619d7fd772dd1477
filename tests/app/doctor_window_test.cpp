// A person who cannot connect asks the window what is the matter with the port.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>

#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "app/workbench.h"
#include "core/sim/firmware_boards.h"
#include "core/sim/firmware_server.h"
#include "tests/support/loopback.h"
#include "tests/support/qt_application.h"
#include "tests/support/temp_dir.h"
#include "ui/device_panel.h"
#include "ui/doctor_card.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 60000;

class DoctorWindow : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"}) {
      qputenv(name, (dir_ / name).c_str());
    }
    bench_ = std::make_unique<Workbench>(RigOptions());
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    panel_ = bench_->window().work_page->device_panel;
    bench_->window().showWork(Step::kConnect);
    QTest::qWait(300);  // the list of ports arrives
  }
  void TearDown() override {
    QSignalSpy quiet(&bench_->controller(), &ScanController::quiet);
    bench_->controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(kPatience_ms));
  }
  QPushButton* button(const QString& text) {
    for (auto* candidate : panel_->findChildren<QPushButton*>()) {
      if (candidate->text() == text) return candidate;
    }
    return nullptr;
  }
  void press(const QString& text) {
    QPushButton* found = button(text);
    ASSERT_NE(found, nullptr) << text.toStdString();
    ASSERT_TRUE(found->isEnabled());
    found->click();
  }
  // What the card tells after the check of this port.
  QString told(const std::string& port) {
    panel_->choose(QString::fromStdString(port), "sim");
    QSignalSpy checked(&bench_->doctor(), &Doctor::checked);
    press("What is wrong with this port?");
    EXPECT_FALSE(button("Connect")->isEnabled());
    EXPECT_TRUE(checked.count() > 0 || checked.wait(kPatience_ms));
    EXPECT_TRUE(button("Connect")->isEnabled());
    return panel_->findChild<DoctorCard*>()->findChild<QLabel*>()->text();
  }

  const TempDir dir_;
  std::unique_ptr<Workbench> bench_;
  DevicePanel* panel_ = nullptr;
};

TEST_F(DoctorWindow, NamesATurntableAndDoesNotMoveIt) {
  const auto shaft = std::make_shared<Shaft>();
  const auto board = std::make_shared<TurntableFirmware>(
      makeFirmwareBoard("marlin", TurntableFirmwareOptions{}, shaft), SimClock(50.0));
  const auto server = FirmwareServer::start(board, 0);
  ASSERT_TRUE(server.ok());
  const QString text = told("tcp:127.0.0.1:" + std::to_string((*server)->port()));
  EXPECT_TRUE(text.contains("turntable")) << text.toStdString();
  EXPECT_TRUE(text.contains("Marlin"));
  EXPECT_TRUE(text.contains("steps a turn"));
  EXPECT_EQ(shaft->steps(), 0);
}

TEST_F(DoctorWindow, TellsAPortThatIsNotThereAndAWordThatNamesNone) {
  EXPECT_TRUE(told("/dev/no-such-port").contains("No such device"));
  EXPECT_TRUE(told("marlin:").contains("names no port"));
}

TEST_F(DoctorWindow, TellsAPortThatMayNotBeOpened) {
  if (geteuid() == 0) GTEST_SKIP() << "root may open everything";
  const auto file = putFile(dir_ / "port", "");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_TRUE(told(file.string()).contains("No permission"));
}

TEST_F(DoctorWindow, StopsAskingAPortThatIsSilent) {
  const auto [listener, port] = test::listenOnLoopback();
  panel_->choose("tcp:127.0.0.1:" + QString::number(port), "sim");
  QSignalSpy stopped(&bench_->doctor(), &Doctor::stopped);
  press("What is wrong with this port?");
  QTest::qWait(500);
  QElapsedTimer clock;
  clock.start();
  press("Stop checking");
  ASSERT_TRUE(stopped.wait(kPatience_ms));
  EXPECT_LT(clock.elapsed(), 1000);
  EXPECT_NE(button("What is wrong with this port?"), nullptr);
  close(listener);
}

TEST_F(DoctorWindow, LooksAtAllPortsWhenNoneIsChosen) {
  panel_->choose("sim:duck", "sim");
  QSignalSpy checked(&bench_->doctor(), &Doctor::checked);
  press("Why is my turntable not listed?");
  EXPECT_TRUE(checked.count() > 0 || checked.wait(kPatience_ms));
}

}  // namespace
}  // namespace gyre
