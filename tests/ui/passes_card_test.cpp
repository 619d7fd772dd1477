// What is offered for several passes, and what merging them told, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/passes_card.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

QPushButton* button(const PassesCard& card, const QString& begins_with) {
  for (QPushButton* candidate : card.findChildren<QPushButton*>()) {
    if (candidate->text().startsWith(begins_with)) return candidate;
  }
  ADD_FAILURE() << begins_with.toStdString();
  return nullptr;
}

QString shownTexts(const PassesCard& card) {
  QStringList texts;
  for (const QLabel* label : card.findChildren<QLabel*>()) {
    if (label->isVisibleTo(&card)) texts.append(label->text());
  }
  return texts.join('\n');
}

std::vector<ScanPass> twoPasses() {
  ScanPass upright;
  upright.folder = "/scans/cup";
  ScanPass over;
  over.folder = "/scans/cup-pass2";
  over.fit = PassFit{2126, 0.11, 0.69, 0.0134};
  return {upright, over};
}

TEST(PassesCard, OffersNothingBeforeAScanIsFinished) {
  PassesCard card;
  card.showPhase(ScanPhase::kReady);
  EXPECT_FALSE(button(card, "Turn it over")->isEnabled());
  EXPECT_FALSE(button(card, "Merge with another")->isEnabled());
  card.showOffer({true, {}});
  EXPECT_TRUE(button(card, "Turn it over")->isEnabled());
  EXPECT_TRUE(button(card, "Merge with another")->isEnabled());
  card.showPhase(ScanPhase::kScanning);
  EXPECT_FALSE(button(card, "Turn it over")->isEnabled());
}

TEST(PassesCard, OffersToMergeWithThePassBefore) {
  PassesCard card;
  card.showPhase(ScanPhase::kDone);
  card.showOffer({true, "cup"});
  QSignalSpy asked(&card, &PassesCard::mergeRequested);
  button(card, "Merge with cup")->click();
  EXPECT_EQ(asked.count(), 1);
  card.showOffer({true, {}});
  EXPECT_FALSE(button(card, "Merge with")->isVisibleTo(&card));
}

TEST(PassesCard, StopsWhileItMerges) {
  PassesCard card;
  card.showOffer({true, "cup"});
  EXPECT_FALSE(button(card, "Stop merging")->isVisibleTo(&card));
  card.showPhase(ScanPhase::kMerging);
  QSignalSpy asked(&card, &PassesCard::stopRequested);
  button(card, "Stop merging")->click();
  EXPECT_EQ(asked.count(), 1);
  EXPECT_FALSE(button(card, "Merge with cup")->isVisibleTo(&card));
}

TEST(PassesCard, TellsHowThePassesFit) {
  PassesCard card;
  card.showPasses(twoPasses());
  const QString told = shownTexts(card);
  EXPECT_TRUE(told.contains("cup-pass2: it overlaps by 69 %")) << told.toStdString();
  EXPECT_TRUE(told.contains("0.013 mm apart"));
  EXPECT_TRUE(told.contains("It stands as in cup."));
  card.showPasses({});
  EXPECT_FALSE(shownTexts(card).contains("overlaps"));
}

TEST(PassesCard, TellsWhyPassesWereNotMerged) {
  PassesCard card;
  card.showRefusal({Error::Code::kTooFew, "No spots were found.", "Is it the same object?"});
  EXPECT_TRUE(shownTexts(card).contains("Not merged"));
  EXPECT_TRUE(shownTexts(card).contains("No spots were found. Is it the same object?"));
  card.showPhase(ScanPhase::kMerging);  // another try
  EXPECT_FALSE(shownTexts(card).contains("Not merged"));
}

}  // namespace
}  // namespace gyre
