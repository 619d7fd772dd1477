// Placing the object: what is told of the table, and of a quick look around the object.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/place_panel.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include <opencv2/core.hpp>

#include "tests/support/qt_application.h"
#include "ui/quick_look_card.h"

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
    if (candidate->text() == text) return candidate;
  }
  return nullptr;
}

int thumbnails(const QWidget& parent) {
  int count = 0;
  for (const QLabel* label : parent.findChildren<QLabel*>()) {
    count += !label->pixmap(Qt::ReturnByValue).isNull() && label->isVisibleTo(&parent) ? 1 : 0;
  }
  return count;
}

// All is well but the texture, which two of three pictures lack.
QuickLookPtr plainObject() {
  QuickLook look;
  look.verdict = QuickVerdict::kRedo;
  for (QuickFinding& finding : look.findings) finding.sentence = "As it should be.";
  look.findings[3] = {QuickAspect::kTextured, QuickVerdict::kRedo, "Hardly any texture.",
                      "Put dots on it."};
  Frame frame;
  frame.image_bgr = cv::Mat(60, 80, CV_8UC3, cv::Scalar(90, 120, 150));
  for (const QuickVerdict verdict :
       {QuickVerdict::kGood, QuickVerdict::kRedo, QuickVerdict::kAcceptable}) {
    QuickView view;
    view.picture = std::make_shared<const Frame>(frame);
    view.verdict = verdict;
    view.fault = verdict == QuickVerdict::kGood ? "" : "too <plain>";
    look.views.push_back(view);
  }
  return std::make_shared<const QuickLook>(std::move(look));
}

TEST(PlacePanel, TellsTheCylinderInWhichTheObjectStaysInThePicture) {
  PlacePanel panel;
  EXPECT_TRUE(shownTexts(panel).contains("once camera and table are calibrated"));
  panel.showUsable(UsableCylinder{61.4, 82.6});
  EXPECT_TRUE(shownTexts(panel).contains("123 mm wide and 83 mm high"));
}

TEST(PlacePanel, AsksForAQuickLookAndForItsEnd) {
  PlacePanel panel;
  QSignalSpy looks(panel.quick_look, &QuickLookCard::lookRequested);
  QSignalSpy stops(panel.quick_look, &QuickLookCard::stopRequested);
  QPushButton* look = button(panel, "Look around the object");
  ASSERT_NE(look, nullptr);
  panel.showPhase(ScanPhase::kIdle);
  EXPECT_FALSE(look->isEnabled());
  panel.showPhase(ScanPhase::kReady);
  look->click();
  EXPECT_EQ(looks.count(), 1);
  panel.showPhase(ScanPhase::kQuickLook);
  EXPECT_FALSE(button(panel, "The object is in place")->isEnabled());
  EXPECT_EQ(look->text(), "Stop the table");
  look->click();
  EXPECT_EQ(stops.count(), 1);
  EXPECT_EQ(looks.count(), 1);
}

TEST(PlacePanel, ShowsWhatTheLookFoundWithAdviceAndThePoorPictures) {
  PlacePanel panel;
  panel.showPhase(ScanPhase::kReady);
  EXPECT_EQ(thumbnails(panel), 0);
  panel.quick_look->showLook(plainObject());
  const QString texts = shownTexts(panel);
  EXPECT_TRUE(texts.contains("✗ Better mend this first."));
  EXPECT_TRUE(texts.contains("As it should be."));
  EXPECT_TRUE(texts.contains("Put dots on it."));
  EXPECT_TRUE(texts.contains("2: too <plain>"));
  EXPECT_EQ(thumbnails(panel), 2);
}

TEST(PlacePanel, NeverForbidsTheScan) {
  PlacePanel panel;
  panel.showPhase(ScanPhase::kReady);
  panel.quick_look->showLook(plainObject());
  QSignalSpy placed(&panel, &PlacePanel::objectPlaced);
  button(panel, "The object is in place")->click();
  EXPECT_EQ(placed.count(), 1);
}

TEST(PlacePanel, ForgetsTheLookWhenTheRigIsLetGo) {
  PlacePanel panel;
  panel.showPhase(ScanPhase::kReady);
  panel.quick_look->showLook(plainObject());
  panel.reset();
  EXPECT_FALSE(shownTexts(panel).contains("Put dots on it."));
  EXPECT_EQ(thumbnails(panel), 0);
}

}  // namespace
}  // namespace gyre
