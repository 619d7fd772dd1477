// The window: everything has a name, and offers only what is possible now.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/main_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include <QAbstractButton>
#include <QAccessible>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "tests/support/qt_application.h"
#include "ui/banner.h"
#include "ui/clean_panel.h"
#include "ui/job_bar.h"
#include "ui/measure_panel.h"
#include "ui/mesh_panel.h"
#include "ui/model_tools.h"
#include "ui/start_page.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

class MainWindowTest : public testing::Test {
 protected:
  void SetUp() override {
    window_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window_));
  }
  static QPushButton* button(QWidget& parent, const QString& text) {
    for (QPushButton* candidate : parent.findChildren<QPushButton*>()) {
      if (candidate->text() == text) return candidate;
    }
    return nullptr;
  }
  MainWindow window_;
};

TEST_F(MainWindowTest, GivesEverythingThatTakesTheFocusAName) {
  for (const QWidget* widget : window_.findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || widget->inherits("QLabel")) continue;
    if (widget->parentWidget()->inherits("QComboBoxPrivateContainer")) continue;  // Qt's own popup
    QAccessibleInterface* interface =
        QAccessible::queryAccessibleInterface(const_cast<QWidget*>(widget));
    if (interface == nullptr || interface->role() == QAccessible::Client) continue;
    EXPECT_FALSE(interface->text(QAccessible::Name).isEmpty())
        << widget->metaObject()->className() << " in "
        << widget->parentWidget()->metaObject()->className();
  }
}

TEST_F(MainWindowTest, NeverLoadsQt5) {
  std::ifstream maps("/proc/self/maps");
  int qt6 = 0;
  for (std::string line; std::getline(maps, line);) {
    EXPECT_EQ(line.find("libQt5"), std::string::npos) << line;
    if (line.find("libQt6") != std::string::npos) ++qt6;
  }
  EXPECT_GT(qt6, 0);
}

TEST_F(MainWindowTest, BeginsWithTheStartPage) {
  EXPECT_TRUE(window_.start_page->isVisible());
  window_.showWork(Step::kConnect);
  EXPECT_FALSE(window_.start_page->isVisible());
  EXPECT_TRUE(window_.work_page->isVisible());
}

TEST_F(MainWindowTest, ScrollsPanelsInsteadOfSqueezingTheirTexts) {
  applyTheme(*qApp, ThemeChoice::kLight);  // its sheet sets heights
  MainWindow window;                       // made under the sheet, as the program's is
  window.resize(1320, 840);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  window.showWork(Step::kScan);
  QTest::qWait(20);
  WorkPage* page = window.work_page;
  page->measure_panel->showKept("Kept in measurements.json in the scan's folder.");
  Bounds bounds;
  bounds.include({-30.0, -30.0, 0.0});
  bounds.include({30.0, 30.0, 60.0});
  page->clean_panel->showSurface(bounds, 40000);
  window.showWork(Step::kMesh);  // filled while it was hidden, and changed when it is shown
  Measurement measured;
  measured.to_in_table = {30.0, 0.0, 0.0};
  measured.length_mm = 30.0;
  measured.points_sigma_mm = 0.01;
  measured.scale_sigma_mm = 0.01;
  measured.caliper_mm = 30.5;
  page->measure_panel->showMeasurements({measured}, 0);
  for (auto* box : page->clean_panel->findChildren<QCheckBox*>()) box->click();
  CleanReport report;
  report.steps = {
      {"Smooth", 9, 9, {{"vertices held by their sigma", 94.6, "%"}}},
      {"Crop", 9, 8, {{"triangles removed", 12345.0, ""}, {"triangles cut", 99.0, ""}}}};
  page->clean_panel->showReport(report);
  QTest::qWait(100);
  for (const QWidget* panel : {static_cast<QWidget*>(window.work_page->clean_panel),
                               static_cast<QWidget*>(window.work_page->measure_panel),
                               static_cast<QWidget*>(window.work_page->mesh_panel)}) {
    for (const QLabel* label : panel->findChildren<QLabel*>()) {
      if (!label->isVisible() || label->text().isEmpty()) continue;
      EXPECT_GE(label->height(), label->heightForWidth(label->width()))
          << label->text().toStdString();
    }
    for (const QWidget* spin : panel->findChildren<QDoubleSpinBox*>()) {
      if (!spin->isVisible()) continue;
      EXPECT_GE(spin->height(), spin->minimumSizeHint().height());
      EXPECT_LE(spin->geometry().bottom(), spin->parentWidget()->rect().bottom());
    }
  }
}

TEST_F(MainWindowTest, ListsTheActionsOnTheModelInItsEditMenu) {
  const ModelTools& tools = *window_.work_page->model_tools;
  QList<QAction*> listed;
  for (const QMenu* menu : window_.menuBar()->findChildren<QMenu*>()) listed += menu->actions();
  for (QAction* action : {tools.undo, tools.redo, tools.before, tools.hatching, tools.measure}) {
    EXPECT_TRUE(listed.contains(action)) << action->text().toStdString();
    EXPECT_FALSE(action->shortcut().isEmpty());
  }
}

TEST_F(MainWindowTest, OffersOnlyWhatIsPossible) {
  JobBar& bar = *window_.work_page->job_bar;
  window_.showPhase(ScanPhase::kIdle);
  EXPECT_FALSE(button(bar, "Start")->isEnabled());
  EXPECT_FALSE(button(bar, "Stop")->isEnabled());
  window_.showPhase(ScanPhase::kReady);
  EXPECT_TRUE(button(bar, "Start")->isEnabled());
  window_.showPhase(ScanPhase::kScanning);
  EXPECT_FALSE(button(bar, "Start")->isEnabled());
  EXPECT_TRUE(button(bar, "Pause")->isEnabled());
  EXPECT_TRUE(button(bar, "Stop")->isEnabled());
  window_.showPhase(ScanPhase::kPaused);
  EXPECT_NE(button(bar, "Resume"), nullptr);
}

TEST_F(MainWindowTest, ShowsTheScanAgainWhenOtherWorkIsOver) {
  JobBar& bar = *window_.work_page->job_bar;
  const auto says = [&](const QString& text) {
    const auto labels = bar.findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](const QLabel* label) { return label->text() == text; });
  };
  const auto* progress = bar.findChild<QProgressBar*>();
  window_.showPhase(ScanPhase::kReady);
  bar.showProgress(0.95, "Judging the result");
  EXPECT_TRUE(says("Judging the result"));
  bar.showRest();
  EXPECT_FALSE(says("Judging the result"));
  EXPECT_TRUE(says("Ready to scan"));
  EXPECT_EQ(progress->value(), 0);
}

TEST_F(MainWindowTest, PausesAndResumesBySpace) {
  QSignalSpy paused(&window_, &MainWindow::pauseRequested);
  QSignalSpy resumed(&window_, &MainWindow::resumeRequested);
  window_.showWork(Step::kScan);
  window_.showPhase(ScanPhase::kScanning);
  QTest::keyClick(&window_, Qt::Key_Space);
  EXPECT_EQ(paused.count(), 1);
  window_.showPhase(ScanPhase::kPaused);
  QTest::keyClick(&window_, Qt::Key_Space);
  EXPECT_EQ(resumed.count(), 1);
}

TEST_F(MainWindowTest, AsksBeforeEscapeStops) {
  QSignalSpy stopped(&window_, &MainWindow::stopRequested);
  window_.showWork(Step::kScan);
  window_.showPhase(ScanPhase::kScanning);
  QTest::keyClick(&window_, Qt::Key_Escape);
  EXPECT_EQ(stopped.count(), 0);
  Banner& banner = *window_.work_page->banner;
  ASSERT_TRUE(banner.isVisible());
  QTest::mouseClick(button(banner, "Go on"), Qt::LeftButton);
  EXPECT_EQ(stopped.count(), 0);
  QTest::keyClick(&window_, Qt::Key_Escape);
  QTest::mouseClick(button(banner, "Stop"), Qt::LeftButton);
  EXPECT_EQ(stopped.count(), 1);
  EXPECT_FALSE(banner.isVisible());
}

TEST_F(MainWindowTest, ClosesOnlyWhenAllowed) {
  QSignalSpy asked(&window_, &MainWindow::closeRequested);
  EXPECT_FALSE(window_.close());
  EXPECT_EQ(asked.count(), 1);
  window_.allowClose();
  EXPECT_TRUE(window_.close());
}

}  // namespace
}  // namespace gyre
