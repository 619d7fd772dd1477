// The calibration wizard, driven as a person would: one action a page, Next only when it is done.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/calibration_wizard.h"

#include <gtest/gtest.h>

#include <string>

#include <QAccessible>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "tests/support/qt_application.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/place_page.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_wizard/target_page.h"
#include "ui/calibration_wizard/turn_page.h"

namespace gyre {
namespace {

QPushButton* buttonOf(const QWidget& parent, QString text) {
  for (QPushButton* candidate : parent.findChildren<QPushButton*>()) {
    QString plain = candidate->text();
    if (plain.remove('&') == text) return candidate;
  }
  return nullptr;
}

QString textOf(const QWidget& parent) {
  QString all;
  for (const QLabel* label : parent.findChildren<QLabel*>()) {
    if (label->isVisible()) all += label->text() + '\n';
  }
  return all;
}

TargetSight sightOf(int seen, std::string sentence) {
  TargetSight sight;
  sight.faces = {{seen, 24, seen >= 12}};
  sight.passes = seen >= 12;
  sight.sentence = std::move(sentence);
  return sight;
}

CalibrationReport reportOf(CalibrationVerdict verdict) {
  CalibrationReport report;
  report.verdict = verdict;
  report.sentence = "Print the target larger.";
  report.local_detail_mm = 0.012;
  report.overall_size_mm = 0.034;
  report.rms_px = 0.051;
  report.sightings = 1200;
  report.views = 24;
  return report;
}

class CalibrationWizardTest : public testing::Test {
 protected:
  void SetUp() override {
    wizard_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&wizard_));
  }
  bool mayGoOn() { return next()->isEnabled(); }
  QPushButton* next() {
    QPushButton* found = buttonOf(wizard_, "Next");
    return found != nullptr ? found : buttonOf(wizard_, "Finish");
  }
  void press(const QString& text) {
    QPushButton* found = buttonOf(wizard_, text);
    ASSERT_NE(found, nullptr) << text.toStdString();
    ASSERT_TRUE(found->isEnabled()) << text.toStdString();
    QTest::mouseClick(found, Qt::LeftButton);
  }
  void reachPlacing() {
    wizard_.target_page->showOffers({{"wedge", "Wedge", "For most tables."}});
    wizard_.target_page->showReady();
    press("Next");
  }
  CalibrationWizard wizard_;
};

TEST_F(CalibrationWizardTest, GivesTheChosenTargetWithTheCalipersReadings) {
  QSignalSpy chosen(wizard_.target_page, &TargetPage::targetChosen);
  wizard_.target_page->showOffers({{"wedge", "Wedge", "a"}, {"cube", "Cube", "b"}});
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(wizard_.target_page->choice(), (TargetChoice{"wedge", {}, {}}));
  EXPECT_FALSE(mayGoOn()) << "nobody has read it yet";
  wizard_.target_page->showReady();
  EXPECT_TRUE(mayGoOn());
  EXPECT_TRUE(textOf(wizard_).contains("Size not verified"));

  const auto readings = wizard_.target_page->findChildren<QDoubleSpinBox*>();
  ASSERT_EQ(readings.size(), 2);
  readings[0]->setValue(99.20);
  readings[1]->setValue(99.85);
  Q_EMIT readings[1]->editingFinished();
  const auto choice = chosen.back().at(0).value<TargetChoice>();
  EXPECT_EQ(choice.ruler_right_mm, 99.20);
  EXPECT_EQ(choice.ruler_down_mm, 99.85);
  wizard_.target_page->showReady();
  EXPECT_TRUE(textOf(wizard_).contains("Size verified"));
}

TEST_F(CalibrationWizardTest, SaysWhatIsWrongWithATarget) {
  wizard_.target_page->showOffers({{"wedge", "Wedge", ""}});
  wizard_.target_page->useFile("/nowhere/mine.json");
  wizard_.target_page->showProblem(
      {Error::Code::kInvalidInput, "The target lacks corners.", "Describe it again."});
  EXPECT_FALSE(mayGoOn());
  EXPECT_TRUE(textOf(wizard_).contains("The target lacks corners. Describe it again."));
}

TEST_F(CalibrationWizardTest, WaitsForTheTargetAndTakesItsWordBackWhenItIsGone) {
  reachPlacing();
  EXPECT_FALSE(mayGoOn());
  wizard_.place_page->showSight(sightOf(3, "Only 3 corners are seen. Turn the target."));
  EXPECT_FALSE(mayGoOn());
  EXPECT_TRUE(textOf(wizard_).contains("Only 3 corners are seen."));
  wizard_.place_page->showSight(sightOf(24, ""));
  EXPECT_TRUE(mayGoOn());
  EXPECT_TRUE(textOf(wizard_).contains("✓ Face 1: 24 of 24"));
  wizard_.place_page->showSight(sightOf(0, "No target is seen."));
  EXPECT_FALSE(mayGoOn());
}

TEST_F(CalibrationWizardTest, TurnsStopsFailsAndTurnsAgain) {
  reachPlacing();
  wizard_.place_page->showSight(sightOf(24, ""));
  press("Next");
  QSignalSpy started(wizard_.turn_page, &TurnPage::startRequested);
  QSignalSpy stopped(wizard_.turn_page, &TurnPage::stopRequested);
  press("Start turning");
  EXPECT_EQ(started.count(), 1);
  wizard_.turn_page->showRunning(0.3, "Picture 8 of 24");
  EXPECT_FALSE(mayGoOn());
  EXPECT_FALSE(buttonOf(wizard_, "Start turning")->isEnabled());
  press("Stop");
  EXPECT_EQ(stopped.count(), 1);
  wizard_.turn_page->showStopped();
  EXPECT_TRUE(buttonOf(wizard_, "Start turning")->isEnabled());
  wizard_.turn_page->showFailure(
      {Error::Code::kTooFew, "The target hardly turned.", "Tighten it."});
  EXPECT_TRUE(textOf(wizard_).contains("The target hardly turned. Tighten it."));
  EXPECT_FALSE(mayGoOn());
  wizard_.turn_page->showDone();
  EXPECT_TRUE(mayGoOn());
}

TEST_F(CalibrationWizardTest, TellsTheVerdictWithBothFiguresAndOffersARedoMarked) {
  wizard_.showStep(WizardStep::kResult);
  EXPECT_FALSE(mayGoOn());
  wizard_.result_page->showReport(reportOf(CalibrationVerdict::kAcceptable), 500.0);
  const QString text = textOf(wizard_);
  EXPECT_TRUE(text.contains("△ Acceptable"));
  EXPECT_TRUE(text.contains("local detail ± 0.012 mm"));
  EXPECT_TRUE(text.contains("overall size ± 0.034 mm (size not verified)"));
  EXPECT_TRUE(text.contains("500 times as long"));
  EXPECT_TRUE(text.contains("Print the target larger."));
  EXPECT_NE(buttonOf(wizard_, "Use this calibration"), nullptr);
  wizard_.result_page->showReport(reportOf(CalibrationVerdict::kRedo), 1.0);
  EXPECT_TRUE(textOf(wizard_).contains("✗ Do it again"));
  QSignalSpy kept(wizard_.result_page, &ResultPage::keepRequested);
  press("Use it all the same, marked");
  EXPECT_EQ(kept.count(), 1);
}

TEST_F(CalibrationWizardTest, GoesTheWholeWayByKeyboard) {
  wizard_.activateWindow();
  EXPECT_EQ(wizard_.step(), WizardStep::kTarget);
  wizard_.target_page->showReady();
  next()->setFocus();
  QTest::keyClick(next(), Qt::Key_Space);
  EXPECT_EQ(wizard_.step(), WizardStep::kPlace);
  QTest::keyClick(buttonOf(wizard_, "Back"), Qt::Key_Space);
  EXPECT_EQ(wizard_.step(), WizardStep::kTarget);
}

TEST_F(CalibrationWizardTest, GivesEverythingThatTakesTheFocusAName) {
  for (QWidget* widget : wizard_.findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || widget->inherits("QLabel")) continue;
    if (widget->parentWidget()->inherits("QComboBoxPrivateContainer")) continue;
    QAccessibleInterface* interface = QAccessible::queryAccessibleInterface(widget);
    if (interface == nullptr || interface->role() == QAccessible::Client) continue;
    EXPECT_FALSE(interface->text(QAccessible::Name).isEmpty())
        << widget->metaObject()->className() << " in "
        << widget->parentWidget()->metaObject()->className();
  }
}

TEST(CalibrationPanel, KeepsTheWizardWhereItWasLeft) {
  CalibrationPanel panel;
  panel.show();
  EXPECT_FALSE(buttonOf(panel, "Calibrate")->isEnabled());
  panel.allowMeasuring();
  buttonOf(panel, "Calibrate")->click();
  ASSERT_TRUE(panel.showsWizard());
  panel.wizard->showStep(WizardStep::kPlace);
  buttonOf(panel, "Leave")->click();
  EXPECT_FALSE(panel.showsWizard());
  buttonOf(panel, "Go on calibrating")->click();
  EXPECT_EQ(panel.wizard->step(), WizardStep::kPlace);
}

}  // namespace
}  // namespace gyre
