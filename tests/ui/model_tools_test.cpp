// The buttons over the 3D view and the list of measured lengths.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/model_tools.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include "tests/support/qt_application.h"
#include "ui/measure_panel.h"

namespace gyre {
namespace {

QToolButton* toolButton(ModelTools& tools, const QString& name) {
  for (auto* button : tools.findChildren<QToolButton*>()) {
    if (button->accessibleName().startsWith(name)) return button;
  }
  ADD_FAILURE() << "no button " << name.toStdString();
  return nullptr;
}

TEST(ModelTools, SaysWhatWouldBeUndone) {
  ModelTools tools;
  EXPECT_FALSE(tools.undo->isEnabled());
  EXPECT_FALSE(tools.redo->isEnabled());
  EditFacts facts;
  facts.undo = "crop, smooth";
  facts.redo = "reduce";
  tools.showFacts(facts);
  EXPECT_TRUE(tools.undo->isEnabled());
  EXPECT_TRUE(toolButton(tools, "Undo")->toolTip().contains("crop, smooth"));
  EXPECT_TRUE(toolButton(tools, "Redo")->toolTip().contains("reduce"));
  EXPECT_TRUE(tools.undo->text().contains("crop, smooth"));
  tools.showFacts({});
  EXPECT_FALSE(tools.undo->isEnabled());
}

TEST(ModelTools, ShowsWhatWasBeforeWhileTheButtonIsHeld) {
  ModelTools tools;
  tools.show();
  EditFacts facts;
  facts.has_before = true;
  tools.showFacts(facts);
  QSignalSpy side(&tools, &ModelTools::sideChosen);
  auto* button = toolButton(tools, "Hold");
  QTest::mousePress(button, Qt::LeftButton);
  ASSERT_EQ(side.count(), 1);
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kBefore);
  QTest::mouseRelease(button, Qt::LeftButton);
  ASSERT_EQ(side.count(), 2);
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kAfter);
  EXPECT_FALSE(button->isChecked());
  button->setFocus();
  QTest::keyPress(button, Qt::Key_Space);
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kBefore);
  QTest::keyRelease(button, Qt::Key_Space);
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kAfter);
}

TEST(ModelTools, TogglesWhatWasBeforeByItsKeyAndComesBackWhenThereIsNothing) {
  ModelTools tools;
  EditFacts facts;
  facts.has_before = true;
  tools.showFacts(facts);
  QSignalSpy side(&tools, &ModelTools::sideChosen);
  tools.before->trigger();
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kBefore);
  EXPECT_TRUE(toolButton(tools, "Hold")->isChecked());
  tools.showFacts({});
  EXPECT_EQ(side.back().front().value<EditSide>(), EditSide::kAfter);
  EXPECT_FALSE(tools.before->isEnabled());
}

Measurement length(double mm, double sigma_mm) {
  Measurement measurement;
  measurement.to_in_table = {mm, 0.0, 0.0};
  measurement.length_mm = mm;
  measurement.points_sigma_mm = sigma_mm;
  return measurement;
}

class MeasurePanelTest : public testing::Test {
 protected:
  QString text() const {
    QStringList texts;
    for (const auto* label : panel_.findChildren<QLabel*>()) texts.append(label->text());
    return texts.join('\n');
  }
  ModelTools tools_;
  MeasurePanel panel_{tools_.measure};
};

TEST_F(MeasurePanelTest, TurnsMeasuringOnAndOffWithTheAction) {
  auto* button = panel_.findChildren<QPushButton*>().front();
  button->click();
  EXPECT_TRUE(tools_.measure->isChecked());
  tools_.measure->setChecked(false);
  EXPECT_FALSE(button->isChecked());
}

TEST_F(MeasurePanelTest, ListsLengthsAndTellsWhichIsChosen) {
  panel_.showMeasurements({length(10.0, 0.02), length(20.0, 0.02)}, 1);
  auto* list = panel_.findChild<QListWidget*>();
  ASSERT_EQ(list->count(), 2);
  EXPECT_TRUE(list->item(0)->text().contains("10.00"));
  EXPECT_TRUE(list->item(0)->text().contains("±"));
  EXPECT_EQ(list->currentRow(), 1);
  QSignalSpy chosen(&panel_, &MeasurePanel::chosen);
  list->setCurrentRow(0);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen.front().front().toInt(), 0);
  panel_.showMeasurements({}, -1);
  EXPECT_EQ(list->count(), 0);
}

TEST_F(MeasurePanelTest, TakesTheCalipersReadingAndComparesInWords) {
  Measurement measured = length(10.0, 0.02);
  panel_.showMeasurements({measured}, 0);
  QSignalSpy entered(&panel_, &MeasurePanel::caliperEntered);
  auto* caliper = panel_.findChild<QDoubleSpinBox*>();
  caliper->setFocus();
  caliper->selectAll();
  QTest::keyClicks(caliper, "10.01");
  EXPECT_EQ(entered.count(), 0);  // not while it is being typed
  QTest::keyClick(caliper, Qt::Key_Return);
  ASSERT_EQ(entered.count(), 1);
  EXPECT_EQ(entered.front().at(0).toInt(), 0);
  EXPECT_DOUBLE_EQ(entered.front().at(1).toDouble(), 10.01);
  measured.caliper_mm = 10.01;
  panel_.showMeasurements({measured}, 0);
  EXPECT_TRUE(text().contains("Within the ±"));
  measured.caliper_mm = 10.03;
  EXPECT_TRUE(caliperWords(measured).contains("Within twice the ±"));
  measured.caliper_mm = 10.5;
  EXPECT_TRUE(caliperWords(measured).contains("Outside the ±"));
  EXPECT_EQ(entered.count(), 1);  // what is shown is not told again
}

TEST_F(MeasurePanelTest, JudgesNothingWhereTheUncertaintyIsUnknown) {
  Measurement measured = length(10.0, 0.0);
  measured.points_sigma_mm.reset();
  measured.caliper_mm = 11.0;
  EXPECT_FALSE(caliperWords(measured).contains("Outside"));
  EXPECT_FALSE(caliperWords(measured).isEmpty());
}

TEST_F(MeasurePanelTest, TakesTheChosenLengthAway) {
  panel_.showMeasurements({length(10.0, 0.02), length(20.0, 0.02)}, 1);
  QSignalSpy removed(&panel_, &MeasurePanel::removeRequested);
  for (auto* button : panel_.findChildren<QPushButton*>()) {
    if (button->text() == "Remove this length") button->click();
  }
  ASSERT_EQ(removed.count(), 1);
  EXPECT_EQ(removed.front().front().toInt(), 1);
}

}  // namespace
}  // namespace gyre
