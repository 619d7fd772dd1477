// A calibration in the window on the simulated rig, driven as a person would: with a good target,
// without one, and with one that is out of focus.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "app/workbench.h"
#include "core/base/units.h"
#include "core/calib/match/target_sketch.h"
#include "core/calib/targets/standard_targets.h"
#include "core/geometry/turntable_pose.h"
#include "core/io/calibration_record_file.h"
#include "core/sim/rig.h"
#include "tests/support/qt_application.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/place_page.h"
#include "ui/calibration_wizard/result_page.h"
#include "ui/calibration_wizard/target_page.h"
#include "ui/calibration_wizard/turn_page.h"
#include "ui/camera_view.h"
#include "ui/device_panel.h"
#include "ui/focus_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 240000;  // a sanitizer is ten times slower

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
    bench_->window().showWork(Step::kFocus);
    Q_EMIT page().device_panel->connectRequested(turntable, "sim");
    ASSERT_TRUE(waitFor([this] { return bench_->controller().phase() == ScanPhase::kReady; }));
    EXPECT_FALSE(button("Calibrate")->isEnabled()) << "the camera is not locked";
    for (QPushButton* lock : page().focus_panel->findChildren<QPushButton*>()) {
      if (lock->text().remove('&') == "Lock the camera") lock->click();
    }
    ASSERT_TRUE(waitFor([this] { return button("Calibrate")->isEnabled(); }));
    bench_->window().showWork(Step::kCalibrate);
    press("Calibrate");
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
  // The target is chosen and the page on which it is put in place is shown.
  void chooseWedge() { choose("wedge"); }
  void choose(const QString& name) {
    pick(name);
    ASSERT_TRUE(waitFor([this] { return mayGoOn(); }));
    press("Next");
  }
  void pick(const QString& name) {
    auto* offers = wizard().target_page->findChildren<QComboBox*>().front();
    const int index = offers->findData(name);
    ASSERT_GE(index, 0);
    QSignalSpy ready(wizard().target_page, &TargetPage::targetChosen);
    offers->setCurrentIndex(index);
    Q_EMIT offers->activated(index);
    ASSERT_EQ(ready.count(), 1);
  }
  // A click where the live picture shows a pixel.
  void clickAt(const Eigen::Vector2d& pixel, const QSizeF& picture) {
    CameraView* view = page().camera_view;
    const QSizeF fitted = picture.scaled(view->size(), Qt::KeepAspectRatio);
    const double scale = fitted.width() / picture.width();
    const QPointF corner(0.5 * (view->width() - fitted.width()),
                         0.5 * (view->height() - fitted.height()));
    const QPointF at = corner + scale * QPointF(pixel.x() + 0.5, pixel.y() + 0.5);
    QTest::mouseClick(view, Qt::LeftButton, Qt::NoModifier, at.toPoint());
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

TEST_F(CalibrationWindow, TakesSixClicksForTheTarget) {
  const RigOptions options = smallRig();
  open(options, "sim:target:cube");
  // As the drawing shows it: the camera half way between the target's axes.
  const Rigid3 table_from_target = tableFromTarget(options.sim);
  const double yaw_rad =
      std::atan2(table_from_target.rotation(1, 0), table_from_target.rotation(0, 0));
  bench_->controller().devices().confirmTurntable();
  bench_->controller().devices().turnToDeg(-45.0 - degFromRad(yaw_rad));
  choose("cube");
  ASSERT_TRUE(waitFor([this] { return !bench_->controller().devices().busy() || mayGoOn(); }));
  ASSERT_TRUE(seesTarget(20)) << wizard().place_page->hindrance().toStdString();

  const Target cube = standardTarget("cube")->target;
  const Calibration truth = trueCalibration(options.sim);
  const double table_rad =
      trueAngleRad(options.sim, bench_->controller().devices().rig()->room->shaft->steps());
  const Rigid3 cam_from_target = camFromTable(*truth.cam_from_table, table_rad) * table_from_target;
  const QSizeF picture(truth.camera.width_px, truth.camera.height_px);
  const auto clickAll = [&](std::vector<int> ids) {
    press("Show it by hand…");
    for (const int id : ids) {
      const auto corner = std::find_if(cube.corners.begin(), cube.corners.end(),
                                       [id](const TargetCorner& c) { return c.id == id; });
      clickAt(*truth.camera.project(cam_from_target * corner->position_in_target), picture);
    }
  };
  const std::vector<int> asked = sketchOf(cube).to_click;
  QSignalSpy seen(&bench_->calibrations(), &CalibrationController::sightSeen);
  clickAll(asked);
  EXPECT_NE(button("Show it by hand…"), nullptr);  // no corner is asked for any more
  seen.clear();
  ASSERT_TRUE(waitFor([&] { return seen.count() >= 2; }));
  EXPECT_TRUE(mayGoOn()) << wizard().place_page->hindrance().toStdString();

  // On wrong corners they are refused, and what was known before is kept.
  std::vector<int> wrong = asked;
  std::swap(wrong[0], wrong[5]);
  std::swap(wrong[1], wrong[3]);
  QStringList sentences;
  QObject::connect(
      &bench_->calibrations(), &CalibrationController::sightSeen, wizard().place_page,
      [&](const TargetSight& sight) { sentences.append(QString::fromStdString(sight.sentence)); });
  clickAll(wrong);
  EXPECT_TRUE(waitFor([&] { return sentences.join(' ').contains("Click six corners"); }));

  // Clicking can be given up, and is when the wizard is left.
  press("Show it by hand…");
  press("Stop clicking");
  EXPECT_NE(button("Show it by hand…"), nullptr);
  press("Show it by hand…");
  EXPECT_EQ(page().camera_view->cursor().shape(), Qt::CrossCursor);
  press("Leave");
  EXPECT_NE(page().camera_view->cursor().shape(), Qt::CrossCursor);
}

TEST_F(CalibrationWindow, RefusesAFlatTargetUnlessTheLensIsKept) {
  open(smallRig(), "sim:target:ring");
  pick("ring");
  ASSERT_TRUE(
      waitFor([this] { return !wizard().target_page->hindrance().contains("being read"); }));
  EXPECT_TRUE(wizard().target_page->hindrance().contains("lies flat"))
      << wizard().target_page->hindrance().toStdString();
  EXPECT_FALSE(mayGoOn());
  auto* keep = wizard().target_page->findChildren<QCheckBox*>().front();
  ASSERT_TRUE(keep->isEnabled());  // the simulated rig knows its camera
  keep->click();
  ASSERT_TRUE(waitFor([this] { return mayGoOn(); }));
  press("Next");
  ASSERT_TRUE(seesTarget(20)) << wizard().place_page->hindrance().toStdString();
  press("Next");
  press("Start turning");
  QSignalSpy failed(&bench_->calibrations(), &CalibrationController::turnFailed);
  ASSERT_TRUE(waitFor([&] { return wizard().step() == WizardStep::kResult || !failed.isEmpty(); }));
  ASSERT_TRUE(failed.isEmpty()) << failed.front().at(0).value<Error>().sentence();
  const Calibration& found = bench_->calibrations().outcome()->rig.calibration;
  const Calibration truth = trueCalibration(smallRig().sim);
  EXPECT_EQ(found.camera.fx, truth.camera.fx);
  EXPECT_LT(
      found.cam_from_table->rotation.col(2).cross(truth.cam_from_table->rotation.col(2)).norm(),
      radFromDeg(0.05));
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

TEST_F(CalibrationWindow, SaysThatTheTargetWasTakenAwayBeforeTheTurn) {
  open(smallRig(), "sim:target");
  chooseWedge();
  ASSERT_TRUE(seesTarget(20)) << wizard().place_page->hindrance().toStdString();
  press("Next");
  QSignalSpy failed(&bench_->calibrations(), &CalibrationController::turnFailed);
  bench_->controller().devices().rig()->room->setTable(TableLoad::kEmpty);
  press("Start turning");
  ASSERT_TRUE(failed.wait(kPatience_ms));
  EXPECT_FALSE(failed.front().at(0).value<Error>().sentence().empty());
  EXPECT_EQ(wizard().step(), WizardStep::kTurn);
  EXPECT_FALSE(mayGoOn());
  EXPECT_TRUE(button("Start turning")->isEnabled());
  EXPECT_EQ(bench_->calibrations().outcome(), nullptr);
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
