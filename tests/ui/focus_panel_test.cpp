// Framing and focusing: meters that follow the picture, modes to choose, and what was locked.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/focus_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "tests/support/qt_application.h"
#include "ui/meter.h"

namespace gyre {
namespace {

QString shownTexts(const QWidget& widget) {
  QStringList texts;
  for (const QLabel* label : widget.findChildren<QLabel*>()) {
    if (label->isVisibleTo(&widget)) texts.append(label->text());
  }
  return texts.join('\n');
}

QPushButton* button(const QWidget& parent, const QString& text) {
  for (QPushButton* candidate : parent.findChildren<QPushButton*>()) {
    if (candidate->text().remove('&') == text) return candidate;
  }
  return nullptr;
}

CameraInfo camera() {
  CameraInfo info;
  info.width_px = 1920;
  info.height_px = 1080;
  info.frames_per_s = 30.0;
  info.mode = "1920x1080@MJPG";
  info.modes = {"2592x1944@YUYV@2", "1920x1080@MJPG@30", "640x480@YUYV@30"};
  return info;
}

TEST(FocusPanel, SaysWhatComesFirstWhileNothingIsConnected) {
  FocusPanel panel;
  EXPECT_TRUE(shownTexts(panel).contains("Connect turntable and camera first"));
  EXPECT_FALSE(button(panel, "Lock the camera")->isEnabled());
}

TEST(FocusPanel, FollowsThePictureAndAdvises) {
  FocusPanel panel;
  panel.showPhase(ScanPhase::kReady);
  panel.showCamera(camera());
  const auto meters = panel.findChildren<Meter*>();
  ASSERT_EQ(meters.size(), 2);
  panel.showFocus({0.3, 0.2, 0.0, "White areas hold no detail."});
  EXPECT_EQ(meters[0]->state(), MeterState::kBad);
  EXPECT_EQ(meters[1]->state(), MeterState::kBad);
  EXPECT_TRUE(shownTexts(panel).contains("White areas hold no detail."));
  panel.showFocus({0.95, 0.0, 0.0, ""});
  EXPECT_EQ(meters[0]->state(), MeterState::kGood);
  EXPECT_EQ(meters[1]->state(), MeterState::kGood);
  EXPECT_FALSE(shownTexts(panel).contains("White areas hold no detail."));
}

TEST(FocusPanel, OffersTheModesThatTheCameraHasAndAsksForAnotherOne) {
  FocusPanel panel;
  panel.showPhase(ScanPhase::kReady);
  panel.showCamera(camera());
  EXPECT_TRUE(shownTexts(panel).contains("1920 × 1080 px, 30 a second"));
  auto* modes = panel.findChild<QComboBox*>();
  ASSERT_EQ(modes->count(), 3);
  EXPECT_EQ(modes->currentIndex(), 1);
  QSignalSpy chosen(&panel, &FocusPanel::modeChosen);
  Q_EMIT modes->activated(1);
  EXPECT_EQ(chosen.count(), 0) << "it is in this mode already";
  Q_EMIT modes->activated(2);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen.front().at(0).toString(), "640x480@YUYV@30");
  CameraInfo single = camera();
  single.modes = {};
  panel.showCamera(single);
  EXPECT_FALSE(modes->isVisibleTo(&panel));
}

TEST(FocusPanel, NamesWhatWasReadBackAndWhatCouldNotBeLocked) {
  FocusPanel panel;
  panel.showPhase(ScanPhase::kReady);
  panel.showCamera(camera());
  QSignalSpy asked(&panel, &FocusPanel::lockRequested);
  button(panel, "Lock the camera")->click();
  EXPECT_EQ(asked.count(), 1);
  EXPECT_FALSE(button(panel, "Go on to calibrating")->isEnabled()) << "asking is not yet locking";
  CameraInfo locked = camera();
  locked.controls = {{"focus", true, 120.0, ""},
                     {"exposure", true, 0.0, "", "1/125"},
                     {"gain", false, 0.0, "the driver has none"}};
  panel.showLocks(locked);
  EXPECT_TRUE(shownTexts(panel).contains("✓ focus: locked at 120"));
  EXPECT_TRUE(shownTexts(panel).contains("✓ exposure: locked at 1/125"));
  EXPECT_TRUE(shownTexts(panel).contains("✗ gain: the driver has none"));
  QSignalSpy on(&panel, &FocusPanel::goOnRequested);
  button(panel, "Go on to calibrating")->click();
  EXPECT_EQ(on.count(), 1);
}

TEST(FocusPanel, ForgetsTheLocksOfACameraThatWasOpenedAnew) {
  FocusPanel panel;
  panel.showPhase(ScanPhase::kReady);
  CameraInfo locked = camera();
  locked.controls = {{"focus", true, 120.0, ""}};
  panel.showLocks(locked);
  panel.showCamera(camera());
  EXPECT_FALSE(shownTexts(panel).contains("locked at"));
  EXPECT_FALSE(button(panel, "Go on to calibrating")->isEnabled());
}

}  // namespace
}  // namespace gyre
