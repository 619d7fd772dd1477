// A calibration in the window on the simulated rig, driven as a person would: with a good target,
// without one, and with one that is out of focus.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <memory>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "app/workbench.h"
#include "core/io/calibration_record_file.h"
#include "core/sim/rig.h"
#include "tests/support/qt_application.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/focus_page.h"
#include "ui/calibration_wizard/place_page.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_wizard/target_page.h"
#include "ui/calibration_wizard/turn_page.h"
#include "ui/device_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 60000;

RigOptions smallRig() {
  RigOptions options;
  options.sim = atImageWidth(options.sim, 960);  // smaller, and the codes cannot be read
  return options;
}

class CalibrationWindow : public testing::Test {
 protected:
  void open(const RigOptions& rig, const QString& turntable) {
    ASSERT_TRUE(folder_.isValid());
    qputenv("XDG_CONFIG_HOME", folder_.filePath("config").toUtf8());
    qputenv("XDG_DATA_HOME", folder_.filePath("data").toUtf8());
    bench_ = std::make_unique<Workbench>(rig);
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    bench_->window().showWork(Step::kCalibrate);
    Q_EMIT page().device_panel->connectRequested(turntable, "sim");
    ASSERT_TRUE(waitFor([this] { return bench_->controller().phase() == ScanPhase::kReady; }));
    press("Calibrate");
    press("Lock the camera");
    ASSERT_TRUE(waitFor([this] { return mayGoOn(); }));
    press("Next");
  }
  void TearDown() override {
    if (!bench_) return;
    QSignalSpy quiet(&bench_->controller(), &ScanController::quiet);
    bench_->controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(30000));
  }
  WorkPage& page() { return *bench_->window().work_page; }
  CalibrationWizard& wizard() { return *page().calibration_panel->wizard; }
  template <class Condition>
  bool waitFor(Condition condition) {
    return QTest::qWaitFor(condition, kPatience_ms);
  }
  QPushButton* button(const QString& text) {
    for (QPushButton* candidate : page().calibration_panel->findChildren<QPushButton*>()) {
      QString plain = candidate->text();
      if (plain.remove('&') == text) return candidate;
    }
    return nullptr;
  }
  void press(const QString& text) {
    QPushButton* found = button(text);
    ASSERT_NE(found, nullptr) << text.toStdString();
    ASSERT_TRUE(found->isEnabled()) << text.toStdString();
    found->click();
  }
  bool mayGoOn() { return button("Next") != nullptr && button("Next")->isEnabled(); }
  // The wedge is chosen and the page on which it is put in place is shown.
  void chooseWedge() {
    auto* offers = wizard().target_page->findChildren<QComboBox*>().front();
    const int wedge = offers->findData("wedge");
    ASSERT_GE(wedge, 0);
    QSignalSpy ready(wizard().target_page, &TargetPage::targetChosen);
    offers->setCurrentIndex(wedge);
    Q_EMIT offers->activated(wedge);
    ASSERT_EQ(ready.count(), 1);
    ASSERT_TRUE(waitFor([this] { return mayGoOn(); }));
    press("Next");
  }
  // The next few looks at the target; true when one of them is enough.
  bool seesTarget(int looks) {
    QSignalSpy seen(&bench_->calibrations(), &CalibrationController::sightSeen);
    EXPECT_TRUE(waitFor([&] { return seen.count() >= looks || mayGoOn(); }));
    return mayGoOn();
  }

  QTemporaryDir folder_;
  std::unique_ptr<Workbench> bench_;
};

TEST_F(CalibrationWindow, MeasuresTheRigAndKeepsTheResult) {
  open(smallRig(), "sim:target");
  chooseWedge();
  ASSERT_TRUE(seesTarget(20)) << wizard().place_page->hindrance().toStdString();
  press("Next");
  QSignalSpy failed(&bench_->calibrations(), &CalibrationController::turnFailed);
  press("Start turning");
  ASSERT_TRUE(waitFor([&] { return wizard().step() == WizardStep::kResult || !failed.isEmpty(); }));
  ASSERT_TRUE(failed.isEmpty()) << failed.front().at(0).value<Error>().sentence();
  ASSERT_NE(bench_->calibrations().outcome(), nullptr);
  const RigCalibration& rig = bench_->calibrations().outcome()->rig;
  const Calibration truth = trueCalibration(smallRig().sim);
  EXPECT_NE(rig.report.verdict, CalibrationVerdict::kRedo) << rig.report.sentence;
  EXPECT_FALSE(rig.report.size_verified);
  // Three quarters of the default rig's pixels: four times its 0.05 % are allowed.
  EXPECT_NEAR(rig.calibration.camera.fx / truth.camera.fx, 1.0, 0.002);

  press("Use this calibration");
  const double fx = rig.calibration.camera.fx;
  ASSERT_TRUE(
      waitFor([&] { return bench_->controller().calibration()->calibration.camera.fx == fx; }));
  EXPECT_TRUE(bench_->controller().calibration()->camera.has_value());

  QSignalSpy saved(&bench_->calibrations(), &CalibrationController::saved);
  const QString file = folder_.filePath("calibration.json");
  Q_EMIT wizard().result_page->saveRequested(file);
  ASSERT_TRUE(saved.wait(kPatience_ms));
  const auto record = readCalibrationRecord(file.toStdString());
  ASSERT_TRUE(record.ok()) << record.error().sentence();
  ASSERT_TRUE(record->turntable.has_value());
  EXPECT_EQ(record->turntable->direction, 1);
}

TEST_F(CalibrationWindow, SaysThatThereIsNoTarget) {
  open(smallRig(), "sim:duck");
  chooseWedge();
  EXPECT_FALSE(seesTarget(2));
  EXPECT_FALSE(wizard().place_page->hindrance().isEmpty());
}

TEST_F(CalibrationWindow, SaysThatTheTargetIsOutOfFocus) {
  RigOptions rig = smallRig();
  rig.sim.blur_sigma_px = 4.0;
  open(rig, "sim:target");
  chooseWedge();
  EXPECT_FALSE(seesTarget(2));
  const QString why = wizard().place_page->hindrance();
  EXPECT_TRUE(why.contains("sharp") || why.contains("focus") || why.contains("blur"))
      << why.toStdString();
}

TEST_F(CalibrationWindow, StopsInTheMiddleAndMeasuresLater) {
  open(smallRig(), "sim:target");
  chooseWedge();
  ASSERT_TRUE(seesTarget(20)) << wizard().place_page->hindrance().toStdString();
  press("Next");
  QSignalSpy pictures(&bench_->calibrations(), &CalibrationController::pictureTaken);
  QSignalSpy stopped(&bench_->calibrations(), &CalibrationController::stopped);
  press("Start turning");
  ASSERT_TRUE(waitFor([&] { return pictures.count() >= 2; }));
  press("Stop");
  ASSERT_TRUE(stopped.wait(kPatience_ms));
  EXPECT_EQ(bench_->calibrations().outcome(), nullptr);
  EXPECT_TRUE(button("Start turning")->isEnabled());
}

}  // namespace
}  // namespace gyre
