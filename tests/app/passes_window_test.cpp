// An object that is turned over, scanned again and merged in the window, as a person would do it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <QElapsedTimer>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "app/merge_job.h"
#include "app/workbench.h"
#include "core/sim/rig_json.h"
#include "tests/support/command_answer.h"
#include "tests/support/qt_application.h"
#include "tests/support/temp_dir.h"
#include "ui/banner.h"
#include "ui/device_panel.h"
#include "ui/job_bar.h"
#include "ui/mesh_panel.h"
#include "ui/passes_card.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience_ms = 240000;
constexpr int kViews = 36;

RigSettings rigOf(double roll_deg, double yaw_deg) {
  RigSettings rig = atImageWidth(RigSettings{}, 640);
  rig.object_roll_deg = roll_deg;
  rig.object_yaw_deg = yaw_deg;
  return rig;
}

// Two passes of the duck, and one of a mouse, for all tests.
class PassesWindow : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scans_ = new TempDir;
    scan("upright", "duck", rigOf(0.0, 0.0), kViews);
    scan("over", "duck", rigOf(180.0, 50.0), kViews);
    scan("mouse", "mouse", rigOf(0.0, 0.0), kViews / 2);
  }
  static void TearDownTestSuite() {
    delete scans_;
    scans_ = nullptr;
  }
  static void scan(const std::string& name, const std::string& object, const RigSettings& rig,
                   int views) {
    putFile(*scans_ / (name + ".json"), rigToJson(rig));
    const test::Answer scanned =
        test::gyre({"demo", "--object", object, "--rig", (*scans_ / (name + ".json")).string(),
                    "--views", std::to_string(views), "--sim-speed", "100", "--out", at(name)});
    ASSERT_EQ(scanned.code, 0) << scanned.err;
  }
  static std::string at(const std::string& name) { return (*scans_ / name).string(); }

  void SetUp() override {
    qputenv("XDG_CONFIG_HOME", (own_ / "config").c_str());
    qputenv("XDG_DATA_HOME", (own_ / "data").c_str());
    RigOptions options;
    options.sim = rigOf(0.0, 0.0);
    options.sim_speed = 50.0;
    bench_ = std::make_unique<Workbench>(options);
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    page_ = bench_->window().work_page;
    card_ = page_->mesh_panel->passes;
  }
  void TearDown() override {
    QSignalSpy quiet(&controller(), &ScanController::quiet);
    controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(kPatience_ms));
  }
  ScanController& controller() { return bench_->controller(); }
  // False at once when a scan fails, with the reason.
  bool waitForPhase(ScanPhase phase) {
    QSignalSpy failed(&controller(), &ScanController::failed);
    const auto ended = [&] { return controller().phase() == phase || !failed.isEmpty(); };
    EXPECT_TRUE(QTest::qWaitFor(ended, kPatience_ms));
    for (const auto& error : failed) {
      ADD_FAILURE() << error.at(0).value<Error>().sentence();
    }
    return controller().phase() == phase;
  }
  void press(QWidget* parent, const QString& text) {
    for (auto* button : parent->findChildren<QPushButton*>()) {
      if (button->text() != text) continue;
      ASSERT_TRUE(button->isEnabled()) << text.toStdString();
      return button->click();
    }
    ADD_FAILURE() << text.toStdString();
  }
  QString told() const {
    QStringList texts;
    for (const auto* label : card_->findChildren<QLabel*>()) {
      if (label->isVisibleTo(card_)) texts.append(label->text());
    }
    return texts.join('\n');
  }
  void open(const std::string& folder) {
    QSignalSpy made(&controller(), &ScanController::meshMade);
    bench_->open(QString::fromStdString(folder));
    ASSERT_TRUE(made.wait(kPatience_ms));
    ASSERT_TRUE(QTest::qWaitFor([&] { return controller().phase() != ScanPhase::kMeshing; }));
  }
  // By the dialog of "Merge with another pass…".
  void mergeWith(const std::string& folder) {
    press(card_, QString::fromUtf8("Merge with another pass…"));
    auto* dialog = card_->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* name = dialog->findChild<QLineEdit*>();
    dialog->activateWindow();
    ASSERT_TRUE(QTest::qWaitFor([&] { return name->hasFocus(); }));
    name->selectAll();
    QTest::keyClicks(name, QString::fromStdString(folder));
    QTest::keyClick(name, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return controller().phase() == ScanPhase::kMerging; }));
  }
  void scanByHand() {
    press(page_->place_panel, "The object is in place");
    page_->scan_panel->setViews(kViews);
    press(page_->job_bar, "Start");
    ASSERT_TRUE(waitForPhase(ScanPhase::kDone));
  }
  // Vertices of the base that a camera saw.
  std::ptrdiff_t seenBelow() {
    const auto& vertices = controller().mesh()->vertices;
    return std::count_if(vertices.begin(), vertices.end(), [](const MeshVertex& vertex) {
      return vertex.position.z() < 0.5 && vertex.normal.z() < -0.9 && vertex.seen != 0;
    });
  }

  static TempDir* scans_;
  const TempDir own_;
  std::unique_ptr<Workbench> bench_;
  WorkPage* page_ = nullptr;
  PassesCard* card_ = nullptr;
};
TempDir* PassesWindow::scans_ = nullptr;

TEST_F(PassesWindow, TurnsOverScansAgainAndMergesByTheButtons) {
  Q_EMIT bench_->window().newScanRequested();
  QTest::qWait(100);
  page_->device_panel->choose("sim:duck", "sim");
  press(page_->device_panel, "Connect");
  ASSERT_TRUE(waitForPhase(ScanPhase::kReady));
  page_->scan_panel->setFolder(QString::fromStdString((own_ / "duck").string()));
  scanByHand();
  EXPECT_LE(seenBelow(), 50);
  press(card_, "Turn it over and scan again");
  EXPECT_EQ(page_->shownStep(), Step::kPlace);
  EXPECT_TRUE(page_->banner->isVisible());
  EXPECT_EQ(page_->scan_panel->folder().toStdString(), (own_ / "duck-pass2").string());
  scanByHand();
  EXPECT_EQ(controller().folder(), own_ / "duck-pass2");
  press(card_, "Merge with duck");
  EXPECT_EQ(controller().phase(), ScanPhase::kMerging);
  ASSERT_TRUE(waitForPhase(ScanPhase::kDone));
  EXPECT_TRUE(told().contains("duck-pass2: it overlaps by")) << told().toStdString();
  EXPECT_TRUE(told().contains("It stands as in duck."));
  EXPECT_EQ(controller().folder(), own_ / "duck-merged");
  ASSERT_NE(controller().mesh(), nullptr);
  EXPECT_GT(seenBelow(), 50);
  EXPECT_TRUE(fs::exists(own_ / "duck-merged/report.html"));
  // A third pass would be laid beside the first two.
  EXPECT_EQ(nextPassFolder(passesOf(controller().folder())), own_ / "duck-pass3");
}

TEST_F(PassesWindow, MergesWithAFolderThatIsChosenAndOpensItAgain) {
  open(at("over"));
  QSignalSpy stages(&controller(), &ScanController::progressed);
  mergeWith(at("upright"));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return controller().phase() != ScanPhase::kMerging; }, kPatience_ms));
  EXPECT_TRUE(told().contains("upright: it overlaps by")) << told().toStdString();
  EXPECT_GT(stages.count(), 3);
  const fs::path merged = controller().folder();
  EXPECT_EQ(merged, fs::path(at("over-merged")));
  open(at("over"));
  EXPECT_FALSE(told().contains("overlaps"));
  open((merged / "passes.json").string());  // as the dialog of "Open…" gives it
  EXPECT_EQ(controller().folder(), merged);
  EXPECT_TRUE(told().contains("upright: it overlaps by"));
  EXPECT_TRUE(controller().calibration().has_value());
  EXPECT_EQ(passesOf(merged), (std::vector<fs::path>{at("over"), at("upright")}));
}

TEST_F(PassesWindow, StopsMergingAtOnceAndLosesNothing) {
  open(at("upright"));
  const MeshPtr before = controller().mesh();
  for (const int wait_ms : {50, 1500, 4000}) {  // while reading, placing and making the surface
    mergeWith(at("over"));
    QTest::qWait(wait_ms);
    if (controller().phase() != ScanPhase::kMerging) break;  // a fast machine
    press(card_, "Stop merging");
    QElapsedTimer clock;
    clock.start();
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return controller().phase() != ScanPhase::kMerging; }, kPatience_ms));
    std::cout << "stopped after " << clock.elapsed() << " ms\n";
    EXPECT_EQ(controller().mesh(), before);
    EXPECT_EQ(controller().folder(), fs::path(at("upright")));
    EXPECT_FALSE(fs::exists(at("upright-merged")));
    EXPECT_FALSE(told().contains("Not merged"));  // it was a wish, not a failure
  }
}

TEST_F(PassesWindow, SaysWhyItDoesNotMergeAnotherObject) {
  open(at("upright"));
  const MeshPtr before = controller().mesh();
  QSignalSpy refused(&controller(), &ScanController::mergeRefused);
  mergeWith(at("mouse"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return refused.count() == 1; }, kPatience_ms));
  EXPECT_TRUE(told().contains("Not merged; the passes stay as they are.")) << told().toStdString();
  EXPECT_TRUE(told().contains("mouse"));
  EXPECT_TRUE(page_->banner->isVisible());
  EXPECT_EQ(controller().mesh(), before);
  EXPECT_FALSE(fs::exists(at("upright-merged")));
}

}  // namespace
}  // namespace gyre
