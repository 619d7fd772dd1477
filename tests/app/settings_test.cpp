// What the window remembers.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/settings.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

class SettingsTest : public testing::Test {
 protected:
  SettingsTest() {
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.path());
  }
  RecentScan scan(const QString& name) {
    QDir(folder_.path()).mkpath(name);
    RecentScan recent;
    recent.folder = folder_.filePath(name);
    recent.title = name;
    recent.when = QDateTime::currentDateTime();
    recent.size_mm = 80.0;
    return recent;
  }
  QTemporaryDir folder_;
};

TEST_F(SettingsTest, ListScansNewestFirstAndOnce) {
  Settings().rememberScan(scan("duck"));
  Settings().rememberScan(scan("vase"));
  Settings().rememberScan(scan("duck"));
  const auto scans = Settings().recentScans();
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0].title, "duck");
  EXPECT_EQ(scans[1].title, "vase");
  EXPECT_EQ(scans[0].size_mm, 80.0);
}

TEST_F(SettingsTest, LeaveOutScansThatAreGone) {
  Settings().rememberScan(scan("gone"));
  QDir(folder_.filePath("gone")).removeRecursively();
  EXPECT_TRUE(Settings().recentScans().empty());
}

TEST_F(SettingsTest, KnowTheTurntablesOfBefore) {
  EXPECT_FALSE(Settings().knowsTurntable("usb-Arduino-1"));
  Settings().rememberTurntable("usb-Arduino-1");
  EXPECT_TRUE(Settings().knowsTurntable("usb-Arduino-1"));
  EXPECT_FALSE(Settings().knowsTurntable(""));
}

TEST_F(SettingsTest, KeepNoPassword) {
  Settings().setDevices("/dev/ttyACM0", "http://anna:secret@camera/video");
  Settings().setTheme(ThemeChoice::kDark);
  EXPECT_FALSE(Settings().camera().contains("secret"));
  EXPECT_EQ(Settings().theme(), ThemeChoice::kDark);
}

TEST_F(SettingsTest, RememberTheCalibrationOfEachRig) {
  const QString file = folder_.filePath("calibration.json");
  EXPECT_EQ(Settings().calibrationFor("usb-1", "0"), QString());
  EXPECT_EQ(Settings().lastCalibration(), QString());
  QFile made(file);
  ASSERT_TRUE(made.open(QIODevice::WriteOnly));
  Settings().rememberCalibration("usb-1", "http://me:secret@host/video", file);
  EXPECT_EQ(Settings().calibrationFor("usb-1", "http://me:other@host/video"), file);
  EXPECT_EQ(Settings().calibrationFor("usb-2", "http://me:secret@host/video"), QString());
  EXPECT_EQ(Settings().lastCalibration(), file);
  EXPECT_FALSE(Settings().keptCalibrationFile("usb-1", "http://me:secret@host").contains("secret"));
  EXPECT_NE(Settings().keptCalibrationFile("usb-1", "0"),
            Settings().keptCalibrationFile("usb-2", "0"));
  made.remove();  // a file that is gone is no calibration
  EXPECT_EQ(Settings().lastCalibration(), QString());
}

}  // namespace
}  // namespace gyre
