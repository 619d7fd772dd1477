// How many views, and what they take: time and room are told before they are spent.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scan_panel.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalSpy>
#include <QTest>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

QString shownTexts(const QWidget& widget) {
  QStringList texts;
  for (const QLabel* label : widget.findChildren<QLabel*>()) {
    if (label->isVisibleTo(&widget)) texts.append(label->text());
  }
  return texts.join('\n');
}

void choose(const ScanPanel& panel, const QString& begins_with) {
  for (QRadioButton* kind : panel.findChildren<QRadioButton*>()) {
    if (kind->text().startsWith(begins_with)) kind->click();
  }
}

ScanCost cost() { return {18.0, 0.5, 3.0, 100.0, 1500.0}; }

TEST(ScanPanel, TellsTimeAndRoomOfAQuickAndOfAFullScan) {
  ScanPanel panel;
  panel.showCost(cost());
  choose(panel, "Quick");
  EXPECT_EQ(panel.views(), 72);
  EXPECT_TRUE(shownTexts(panel).contains("0:54")) << shownTexts(panel).toStdString();
  EXPECT_TRUE(shownTexts(panel).contains("at most 316 MB"));
  choose(panel, "Full");
  EXPECT_EQ(panel.views(), 200);
  EXPECT_TRUE(shownTexts(panel).contains("1:58"));
  EXPECT_TRUE(shownTexts(panel).contains("at most 700 MB"));
  EXPECT_TRUE(shownTexts(panel).contains("1.5 GB free"));
}

TEST(ScanPanel, WarnsOfADiskThatIsTooFullForSoManyViews) {
  ScanPanel panel;
  ScanCost tight = cost();
  tight.free_mb = 500.0;
  panel.showCost(tight);
  choose(panel, "Quick");
  EXPECT_FALSE(shownTexts(panel).contains("too full"));
  choose(panel, "Full");
  EXPECT_TRUE(shownTexts(panel).contains("too full"));
  tight.free_mb.reset();  // not told: no warning
  panel.showCost(tight);
  EXPECT_FALSE(shownTexts(panel).contains("too full"));
  EXPECT_FALSE(shownTexts(panel).contains("free"));
}

TEST(ScanPanel, SaysNothingOfACostThatIsNotKnown) {
  const ScanPanel panel;
  EXPECT_FALSE(shownTexts(panel).contains("About"));
}

TEST(ScanPanel, TellsThatAnotherFolderWasChosen) {
  ScanPanel panel;
  QSignalSpy changed(&panel, &ScanPanel::folderChanged);
  auto* folder = panel.findChild<QLineEdit*>();
  folder->clear();
  changed.clear();
  QTest::keyClicks(folder, "/x");
  EXPECT_EQ(changed.back().at(0).toString(), "/x");
}

QPushButton* button(const ScanPanel& panel, const QString& text) {
  for (QPushButton* candidate : panel.findChildren<QPushButton*>()) {
    if (candidate->text() == text) return candidate;
  }
  return nullptr;
}

TEST(ScanPanel, OffersToGoOnWithAScanThatLacksViews) {
  ScanPanel panel;
  QPushButton* resume = button(panel, "Go on with this scan");
  ScanFacts facts;
  facts.views = 72;
  facts.views_done = 20;
  panel.showFacts(facts);
  panel.showPhase(ScanPhase::kIdle);
  EXPECT_FALSE(resume->isVisibleTo(&panel));  // nothing is connected
  panel.showPhase(ScanPhase::kReady);
  EXPECT_TRUE(resume->isVisibleTo(&panel));
  facts.views_done = 72;
  panel.showFacts(facts);
  EXPECT_FALSE(resume->isVisibleTo(&panel));
}

TEST(ScanPanel, AsksForTrustAndTakesNoForAnAnswer) {
  ScanPanel panel;
  panel.showPhase(ScanPhase::kFailed);
  QSignalSpy given(&panel, &ScanPanel::trustGiven);
  panel.askTrust({Error::Code::kRejected, "The object was moved.", "Put it back."});
  EXPECT_TRUE(shownTexts(panel).contains("The object was moved. Put it back."));
  button(panel, "Do not go on")->click();
  EXPECT_FALSE(shownTexts(panel).contains("moved"));
  EXPECT_EQ(given.count(), 0);
  panel.askTrust({Error::Code::kRejected, "The object was moved.", ""});
  button(panel, "Go on anyway")->click();
  EXPECT_EQ(given.count(), 1);
  panel.askTrust({Error::Code::kRejected, "The object was moved.", ""});
  panel.showPhase(ScanPhase::kScanning);  // another scan has begun
  EXPECT_FALSE(shownTexts(panel).contains("The object was moved."));
}

TEST(ScanPanel, RemarksOnANumberOfViewsThatTheTableDoesNotHave) {
  ScanPanel panel;
  panel.showViewsRemark("Steps differ by one.");
  EXPECT_TRUE(shownTexts(panel).contains("Steps differ by one."));
  panel.showViewsRemark(QString());
  EXPECT_FALSE(shownTexts(panel).contains("Steps differ"));
}

}  // namespace
}  // namespace gyre
