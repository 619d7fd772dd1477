// How many views, and what they take: time and room are told before they are spent.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scan_panel.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
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

}  // namespace
}  // namespace gyre
