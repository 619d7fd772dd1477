// Devices are listed with what hinders them, chosen by what they are opened by.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/device_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

PortInfo port(const std::string& path, const std::string& hindrance) {
  PortInfo info;
  info.path = path;
  info.description = "Arduino Uno";
  info.may_open = hindrance.empty();
  info.hindrance = hindrance;
  return info;
}

bool shows(const QWidget& panel, const QString& text) {
  for (const QLabel* label : panel.findChildren<QLabel*>()) {
    if (label->text().contains(text) && !label->isHidden()) return true;
  }
  return false;
}

TEST(DevicePanel, GivesTheWordsThatAreOpened) {
  DevicePanel panel;
  panel.showPorts({port("/dev/ttyACM0", "")});
  panel.choose("/dev/ttyACM0", "sim");
  EXPECT_EQ(panel.turntable(), "/dev/ttyACM0");
  EXPECT_EQ(panel.camera(), "sim");
}

TEST(DevicePanel, TakesWhatIsTyped) {
  DevicePanel panel;
  panel.choose("tcp:192.168.4.1:23", "http://phone:8080/video");
  EXPECT_EQ(panel.turntable(), "tcp:192.168.4.1:23");
  EXPECT_EQ(panel.camera(), "http://phone:8080/video");
}

TEST(DevicePanel, KeepsTheChoiceWhenTheListComesAgain) {
  DevicePanel panel;
  panel.showPorts({port("/dev/ttyACM0", ""), port("/dev/ttyUSB0", "")});
  panel.choose("/dev/ttyUSB0", "sim");
  panel.showPorts({port("/dev/ttyACM0", ""), port("/dev/ttyUSB0", "")});
  EXPECT_EQ(panel.turntable(), "/dev/ttyUSB0");
}

TEST(DevicePanel, SaysWhatHindersTheChosenPort) {
  DevicePanel panel;
  panel.showPorts({port("/dev/ttyACM0", "You are not in the group dialout.")});
  panel.choose("/dev/ttyACM0", "sim");
  EXPECT_TRUE(shows(panel, "group dialout"));
  panel.choose("sim:duck", "sim");
  EXPECT_FALSE(shows(panel, "group dialout"));
}

TEST(DevicePanel, AsksBeforeItOffersMoves) {
  DevicePanel panel;
  TurntableInfo info;
  info.firmware = "Grbl 1.1h";
  panel.showPhase(ScanPhase::kReady);
  panel.showTurntable(info);
  panel.askWhetherTurntable();
  EXPECT_TRUE(shows(panel, "Is this your turntable?"));
  QSignalSpy confirmed(&panel, &DevicePanel::turntableConfirmed);
  for (QPushButton* button : panel.findChildren<QPushButton*>()) {
    if (button->text() == "Yes, it may turn") button->click();
  }
  EXPECT_EQ(confirmed.count(), 1);
}

TEST(DevicePanel, AsksWhetherALockedBoardMayBeUnlocked) {
  DevicePanel panel;
  panel.showPhase(ScanPhase::kReady);
  QSignalSpy allowed(&panel, &DevicePanel::unlockAllowed);
  QPushButton* unlock = nullptr;
  for (QPushButton* button : panel.findChildren<QPushButton*>()) {
    if (button->text() == "Unlock it") unlock = button;
  }
  ASSERT_NE(unlock, nullptr);
  EXPECT_TRUE(unlock->parentWidget()->isHidden());
  panel.askToUnlock("The board is locked.");
  EXPECT_FALSE(unlock->parentWidget()->isHidden());
  EXPECT_TRUE(shows(panel, "The board is locked."));
  unlock->click();
  EXPECT_EQ(allowed.count(), 1);
  EXPECT_TRUE(unlock->parentWidget()->isHidden());
  panel.askToUnlock("The board is locked.");
  panel.askToUnlock("");
  EXPECT_TRUE(unlock->parentWidget()->isHidden());
}

}  // namespace
}  // namespace gyre
