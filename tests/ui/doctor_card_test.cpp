// What is the matter with ports, in words: every state has its own, and its cure.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/doctor_card.h"

#include <gtest/gtest.h>

#include <set>

#include <QClipboard>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

QPushButton* button(const DoctorCard& card, const QString& text) {
  for (QPushButton* candidate : card.findChildren<QPushButton*>()) {
    if (candidate->text() == text) return candidate;
  }
  return nullptr;
}

QString shownText(const DoctorCard& card) {
  const auto* label = card.findChild<QLabel*>();
  return label->isVisibleTo(&card) ? label->text() : QString();
}

PortDiagnosis forbidden() {
  PortDiagnosis port;
  port.port = "/dev/ttyUSB0";
  port.state = PortState::kNoPermission;
  port.what = "You may not open /dev/ttyUSB0.";
  port.advice = "Run \"sudo adduser you dialout\" & log in again.";
  return port;
}

TEST(DoctorCard, AsksAboutThePortThatIsChosen) {
  DoctorCard card;
  EXPECT_NE(button(card, "Why is my turntable not listed?"), nullptr);
  card.showChosen("/dev/ttyUSB0");
  QPushButton* check = button(card, "What is wrong with this port?");
  ASSERT_NE(check, nullptr);
  QSignalSpy asked(&card, &DoctorCard::checkRequested);
  check->click();
  EXPECT_EQ(asked.count(), 1);
  card.showBegun();
  QSignalSpy stop(&card, &DoctorCard::stopRequested);
  ASSERT_NE(button(card, "Stop checking"), nullptr);
  button(card, "Stop checking")->click();
  EXPECT_EQ(stop.count(), 1);
  EXPECT_EQ(asked.count(), 1);
  card.showStopped();
  EXPECT_NE(button(card, "What is wrong with this port?"), nullptr);
}

TEST(DoctorCard, IsThereOnlyWhileNothingIsConnected) {
  DoctorCard card;
  card.showPhase(ScanPhase::kIdle);
  EXPECT_FALSE(card.isHidden());
  card.showPhase(ScanPhase::kReady);
  EXPECT_TRUE(card.isHidden());
}

TEST(DoctorCard, TellsTheCommandAndCopiesIt) {
  DoctorCard card;
  card.showChosen("/dev/ttyUSB0");
  card.showPorts({forbidden()});
  EXPECT_TRUE(shownText(card).contains("No permission"));
  EXPECT_TRUE(shownText(card).contains("&amp; log in"));  // never taken for markup
  button(card, "Copy")->click();
  const QString copied = QGuiApplication::clipboard()->text();
  EXPECT_TRUE(copied.contains("/dev/ttyUSB0")) << copied.toStdString();
  EXPECT_TRUE(copied.contains("sudo adduser you dialout\" & log in again."));
  card.showChosen("/dev/ttyUSB1");  // what was told holds for another
  EXPECT_TRUE(shownText(card).isEmpty());
}

TEST(DoctorCard, TellsWhatWasHeardAtAWrongSpeed) {
  PortDiagnosis port;
  port.port = "/dev/ttyUSB0";
  port.state = PortState::kGarbled;
  port.what = "Something answers that cannot be read.";
  port.answers = {{9600, "$I", "..~.<", false}, {115200, "$I", "", false}};
  DoctorCard card;
  card.showPorts({port});
  EXPECT_TRUE(shownText(card).contains("Wrong speed"));
  EXPECT_TRUE(shownText(card).contains("9600 baud, asked $I: ..~.&lt;"));
  EXPECT_FALSE(shownText(card).contains("115200"));
}

TEST(DoctorCard, TellsThatNothingIsPluggedIn) {
  DoctorCard card;
  card.showPorts({});
  EXPECT_TRUE(shownText(card).contains("No serial port"));
}

TEST(DoctorCard, HasItsOwnWordsForEveryState) {
  std::set<QString> words;
  for (int state = 0; state <= static_cast<int>(PortState::kFailed); ++state) {
    const QString text = portStateText(static_cast<PortState>(state));
    EXPECT_FALSE(text.isEmpty()) << state;
    EXPECT_TRUE(words.insert(text).second) << text.toStdString();
  }
}

}  // namespace
}  // namespace gyre
