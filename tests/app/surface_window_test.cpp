// Cleaning, undoing, measuring and exporting in the window, driven as a person would.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "app/workbench.h"
#include "core/io/measurements_file.h"
#include "core/io/model_file.h"
#include "core/io/ply.h"
#include "core/io/scan_store.h"
#include "tests/support/qt_application.h"
#include "tests/support/solids.h"
#include "tests/support/temp_dir.h"
#include "ui/banner.h"
#include "ui/clean_panel.h"
#include "ui/clean_row.h"
#include "ui/export_panel.h"
#include "ui/measure_panel.h"
#include "ui/mesh_panel.h"
#include "ui/model_tools.h"
#include "ui/scene_view.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 60000;
constexpr double kRadius_mm = 20.0;

// A ball that stands on the table, its lower part unseen.
Mesh standingBall(std::size_t longitudes) {
  Mesh ball = test::ballMesh(kRadius_mm, longitudes);
  for (MeshVertex& vertex : ball.vertices) {
    vertex.seen = vertex.position.z() > -0.5 * kRadius_mm ? 1 : 0;
    vertex.position.z() += kRadius_mm;
    vertex.rgb = {180, 160, 120};
    vertex.sigma_mm = 0.02F;
  }
  computeNormals(ball);
  return ball;
}

PointCloud pointsOf(const Mesh& mesh) {
  PointCloud cloud;
  for (const MeshVertex& vertex : mesh.vertices) {
    Point& point = cloud.points.emplace_back();
    point.position = vertex.position;
    point.normal = vertex.normal;
    point.covariance = 4e-4 * Eigen::Matrix3d::Identity();
    point.views = {0, 1, 2};
  }
  return cloud;
}

class SurfaceWindowTest : public testing::Test {
 protected:
  void SetUp() override {
    qputenv("XDG_CONFIG_HOME", (dir_ / "config").c_str());
    qputenv("XDG_DATA_HOME", (dir_ / "data").c_str());
    bench_ = std::make_unique<Workbench>(RigOptions());
    bench_->window().show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&bench_->window()));
    page_ = bench_->window().work_page;
  }
  void TearDown() override {
    if (!bench_) return;
    QSignalSpy quiet(&controller(), &ScanController::quiet);
    controller().shutDown();
    EXPECT_TRUE(quiet.count() > 0 || quiet.wait(kPatience_ms));
  }
  ScanController& controller() { return bench_->controller(); }
  SurfaceEditor& editor() { return controller().editor(); }

  // A scan's folder with points and surface in it, as a scan leaves them.
  std::filesystem::path scan(const std::string& name, std::size_t longitudes) {
    const std::filesystem::path folder = dir_ / name;
    ScanSettings settings;
    settings.title = name;
    CalibrationRecord record;
    record.calibration.camera = {640, 480, 1200.0, 1200.0, 0.0, 319.5, 239.5};
    record.calibration.cam_from_table.emplace();
    EXPECT_TRUE(ScanStore::create(folder, settings, record).ok());
    const Mesh ball = standingBall(longitudes);
    EXPECT_TRUE(writePly(folder / "points.ply", pointsOf(ball)).ok());
    EXPECT_TRUE(writePly(folder / "mesh.ply", ball).ok());
    return folder;
  }
  void open(const std::filesystem::path& path) {
    QSignalSpy made(&controller(), &ScanController::meshMade);
    bench_->open(QString::fromStdString(path.string()));
    ASSERT_TRUE(made.wait(kPatience_ms));
    settle();
  }
  // No job goes on, and what their ends have queued is done.
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          return !editor().busy() && !bench_->measures().busy() &&
                 controller().phase() != ScanPhase::kMeshing;
        },
        kPatience_ms));
    QTest::qWait(20);
  }
  QCheckBox* box(const QString& text) {
    for (auto* candidate : page_->clean_panel->findChildren<QCheckBox*>()) {
      if (candidate->text() == text) return candidate;
    }
    ADD_FAILURE() << text.toStdString();
    return nullptr;
  }
  void setNumber(const QString& text, double value) {
    box(text)->parentWidget()->findChild<QDoubleSpinBox*>()->setValue(value);
  }
  // Ticks the step, waits until its preview is there.
  void tick(const QString& text) {
    QSignalSpy made(&editor(), &SurfaceEditor::previewMade);
    box(text)->click();
    ASSERT_TRUE(made.wait(kPatience_ms));
  }
  void press(QWidget* parent, const QString& text) {
    for (auto* button : parent->findChildren<QPushButton*>()) {
      if (button->text() != text) continue;
      ASSERT_TRUE(button->isEnabled()) << text.toStdString();
      return button->click();
    }
    ADD_FAILURE() << text.toStdString();
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::keyClick(&bench_->window(), key, modifiers);
  }
  void chooseKind(MeshMethod kind) {
    auto* kinds = page_->mesh_panel->findChild<QComboBox*>();
    kinds->setCurrentIndex(kinds->findData(static_cast<int>(kind)));
  }
  Mesh exported(const std::string& name) {
    QSignalSpy written(&controller(), &ScanController::written);
    Q_EMIT page_->export_panel->meshExportRequested(QString::fromStdString((dir_ / name).string()));
    EXPECT_TRUE(written.wait(kPatience_ms));
    auto mesh = readMesh(dir_ / name);
    EXPECT_TRUE(mesh.ok());
    return mesh.ok() ? *mesh : Mesh();
  }
  static QString textOf(const QWidget& widget) {
    QStringList texts;
    for (const auto* label : widget.findChildren<QLabel*>()) texts.append(label->text());
    return texts.join('\n');
  }

  const TempDir dir_;
  std::unique_ptr<Workbench> bench_;
  WorkPage* page_ = nullptr;
};

TEST_F(SurfaceWindowTest, PreviewsAppliesUndoesAndExportsTheUndoneState) {
  const std::filesystem::path folder = scan("ball", 60);
  open(folder);
  const MeshPtr first = controller().mesh();
  tick("Crop above");
  setNumber("Crop above", 30.0);
  settle();
  ASSERT_TRUE(QTest::qWaitFor([&] { return boundsOf(*editor().shown()).max.z() < 30.0 + 1e-6; },
                              kPatience_ms));
  EXPECT_EQ(controller().mesh(), first);
  EXPECT_TRUE(textOf(*page_->clean_panel).contains("Volume: 3"));  // before, and then "open"
  // What is exported meanwhile is the surface without the preview.
  EXPECT_NEAR(boundsOf(exported("unpreviewed.ply")).max.z(), 40.0, 1e-4);
  settle();
  press(page_->clean_panel, "Apply");
  EXPECT_NEAR(boundsOf(*controller().mesh()).max.z(), 30.0, 1e-6);
  EXPECT_FALSE(box("Crop above")->isChecked());
  EXPECT_NEAR(boundsOf(exported("cropped.ply")).max.z(), 30.0, 1e-4);
  EXPECT_TRUE(page_->model_tools->undo->toolTip().contains("crop"));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(controller().mesh(), first);
  const Mesh undone = exported("undone.ply");
  EXPECT_EQ(fileText(dir_ / "undone.ply"), fileText(dir_ / "unpreviewed.ply"));
  EXPECT_EQ(undone.triangles, first->triangles);
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_NEAR(boundsOf(*controller().mesh()).max.z(), 30.0, 1e-6);
  EXPECT_EQ(fileText(folder / "mesh.ply").empty(), false);
  EXPECT_EQ(readMesh(folder / "mesh.ply")->triangles.size(), first->triangles.size());
}

TEST_F(SurfaceWindowTest, DiscardsInTheMiddleOfAPreviewWithoutWaiting) {
  open(scan("ball", 300));
  const MeshPtr first = controller().mesh();
  QSignalSpy begun(&editor(), &SurfaceEditor::previewBegun);
  box("Triangles at most")->click();
  ASSERT_TRUE(begun.wait(kPatience_ms));
  QElapsedTimer clock;
  clock.start();
  press(page_->clean_panel, "Discard");
  EXPECT_LT(clock.elapsed(), 100);
  settle();
  EXPECT_EQ(editor().shown(), first);
  EXPECT_FALSE(box("Triangles at most")->isChecked());
  EXPECT_FALSE(page_->model_tools->undo->isEnabled());
}

TEST_F(SurfaceWindowTest, ShowsEachSideByTheKeyB) {
  open(scan("ball", 40));
  const MeshPtr first = controller().mesh();
  setNumber("Smooth, times", 20);
  tick("Smooth, times");
  const MeshPtr preview = editor().shown();
  EXPECT_NE(preview, first);
  key(Qt::Key_B);
  EXPECT_EQ(editor().shown(), first);
  key(Qt::Key_B);
  EXPECT_EQ(editor().shown(), preview);
}

TEST_F(SurfaceWindowTest, UndoesAnotherKindOfSurfaceAndShowsItsKindAgain) {
  open(scan("ball", 60));
  const MeshPtr first = controller().mesh();
  chooseKind(MeshMethod::kAlpha);
  QSignalSpy made(&controller(), &ScanController::meshMade);
  press(page_->mesh_panel, "Build the surface");
  ASSERT_TRUE(made.wait(kPatience_ms));
  settle();
  EXPECT_NE(controller().mesh(), first);
  EXPECT_TRUE(page_->model_tools->undo->isEnabled());
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(controller().mesh(), first);
  auto* kinds = page_->mesh_panel->findChild<QComboBox*>();
  EXPECT_EQ(kinds->currentData().toInt(), static_cast<int>(MeshMethod::kAuto));
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(kinds->currentData().toInt(), static_cast<int>(MeshMethod::kAlpha));
}

TEST_F(SurfaceWindowTest, CountsADraggedGapSizeAsOneStep) {
  open(scan("ball", 60));
  const MeshPtr first = controller().mesh();
  chooseKind(MeshMethod::kAlpha);
  press(page_->mesh_panel, "Build the surface");
  settle();
  auto* gap = page_->mesh_panel->findChild<QDoubleSpinBox*>();
  QSignalSpy made(&controller(), &ScanController::meshMade);
  for (const double gap_mm : {8.0, 9.0, 10.0, 11.0}) {
    gap->setValue(gap_mm);
    ASSERT_TRUE(made.wait(kPatience_ms));
  }
  settle();
  EXPECT_TRUE(page_->model_tools->undo->toolTip().contains("11.00 mm"));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(controller().mesh(), first);
}

TEST_F(SurfaceWindowTest, FollowsTheSliderToItsLastPlaceWhileASurfaceIsBeingMade) {
  open(scan("ball", 100));
  chooseKind(MeshMethod::kAlpha);
  press(page_->mesh_panel, "Build the surface");
  settle();
  controller().makeMesh(MeshMethod::kAlpha, 8.0);
  controller().makeMesh(MeshMethod::kAlpha, 9.0);
  controller().makeMesh(MeshMethod::kAlpha, 10.0);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return editor().now()->wish.gap_size_mm == 10.0; }, kPatience_ms));
}

TEST_F(SurfaceWindowTest, StopsTheSurfaceThatIsBeingMadeByUndo) {
  open(scan("ball", 200));
  tick("Crop above");
  press(page_->clean_panel, "Apply");
  const MeshPtr cropped = controller().mesh();
  chooseKind(MeshMethod::kAdaptive);
  press(page_->mesh_panel, "Build the surface");
  ASSERT_EQ(controller().phase(), ScanPhase::kMeshing);
  key(Qt::Key_Z, Qt::ControlModifier);
  settle();
  QTest::qWait(100);
  EXPECT_EQ(controller().mesh(), cropped);
  EXPECT_TRUE(page_->model_tools->undo->toolTip().contains("crop"));
}

TEST_F(SurfaceWindowTest, SaysWhatAClosedBodyNeedsWhenThePointsAreAlone) {
  const std::filesystem::path folder = scan("ball", 60);
  open(folder / "mesh.ply");
  chooseKind(MeshMethod::kClosed);
  QSignalSpy failed(&controller(), &ScanController::failed);
  Q_EMIT page_->mesh_panel->meshRequested(MeshMethod::kAuto, 0.0);
  ASSERT_EQ(failed.count(), 1);  // a file of a mesh holds no points
  bench_->open(QString::fromStdString((folder / "points.ply").string()));
  settle();
  press(page_->mesh_panel, "Build the surface");
  ASSERT_TRUE(failed.count() == 2 || failed.wait(kPatience_ms));
  EXPECT_TRUE(page_->banner->isVisible());
  EXPECT_TRUE(textOf(*page_->banner).contains("lines of sight"));
  EXPECT_FALSE(textOf(*page_->banner).contains("--method"));
}

TEST_F(SurfaceWindowTest, ForgetsTheHistoryWithAnotherScanAndKeepsItWhenOpeningFails) {
  open(scan("first", 60));
  tick("Crop above");
  press(page_->clean_panel, "Apply");
  const MeshPtr cropped = controller().mesh();
  QSignalSpy failed(&controller(), &ScanController::failed);
  bench_->open(QString::fromStdString(putFile(dir_ / "broken.ply", "no model").string()));
  ASSERT_TRUE(failed.wait(kPatience_ms));
  settle();
  EXPECT_EQ(controller().mesh(), cropped);
  EXPECT_TRUE(page_->model_tools->undo->isEnabled());
  setNumber("Smooth, times", 50);
  box("Smooth, times")->click();  // a preview is on its way when the other comes
  open(scan("second", 20));
  settle();
  EXPECT_EQ(editor().shown(), controller().mesh());
  EXPECT_NE(controller().mesh(), cropped);
  EXPECT_FALSE(page_->model_tools->undo->isEnabled());
  EXPECT_FALSE(box("Smooth, times")->isChecked());
}

TEST_F(SurfaceWindowTest, ClosesInTheMiddleOfAPreview) {
  open(scan("ball", 300));
  QSignalSpy begun(&editor(), &SurfaceEditor::previewBegun);
  box("Even triangles")->click();
  ASSERT_TRUE(begun.wait(kPatience_ms));
  QElapsedTimer clock;
  clock.start();
  bench_->window().close();
  EXPECT_LT(clock.elapsed(), 100);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench_->window().isVisible(); }, kPatience_ms));
  EXPECT_FALSE(editor().busy());
}

TEST_F(SurfaceWindowTest, MeasuresByTwoClicksAndKeepsTheLength) {
  const std::filesystem::path folder = scan("ball", 60);
  open(folder);
  key(Qt::Key_M);
  ASSERT_TRUE(page_->model_tools->measure->isChecked());
  page_->scene_view->lookFrom(ViewSide::kFront);
  page_->scene_view->fit();
  page_->scene_view->picture();
  QWidget* canvas = page_->scene_view->findChild<QWidget*>("canvas");
  ASSERT_NE(canvas, nullptr);
  const QPoint middle(canvas->width() / 2, canvas->height() / 2);
  for (const int off : {-60, 60}) {
    QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, middle + QPoint(off, 0));
  }
  settle();
  ASSERT_EQ(bench_->measures().measurements().size(), 1U);
  const Measurement& measured = bench_->measures().measurements().front();
  EXPECT_NEAR(measured.from_in_table.z(), kRadius_mm, 1.0);
  EXPECT_NEAR((measured.from_in_table - Eigen::Vector3d(0, 0, kRadius_mm)).norm(), kRadius_mm, 0.1);
  EXPECT_TRUE(measured.points_sigma_mm.has_value());
  auto* list = page_->measure_panel->findChild<QListWidget*>();
  EXPECT_EQ(list->count(), 1);
  auto* caliper = page_->measure_panel->findChild<QDoubleSpinBox*>();
  caliper->setValue(measured.length_mm);
  settle();
  EXPECT_TRUE(textOf(*page_->measure_panel).contains("Within the ±"));
  key(Qt::Key_Escape);
  EXPECT_FALSE(page_->model_tools->measure->isChecked());
  QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, middle);
  settle();
  EXPECT_EQ(bench_->measures().measurements().size(), 1U);
  const auto kept = readMeasurements(folder / "measurements.json");
  ASSERT_TRUE(kept.ok());
  ASSERT_EQ(kept->size(), 1U);
  EXPECT_TRUE(kept->front().caliper_mm.has_value());
}

TEST_F(SurfaceWindowTest, SwitchesTheHatchingByTheKeyH) {
  open(scan("ball", 40));
  page_->scene_view->lookFrom(ViewSide::kFront);
  page_->scene_view->fit();
  const QImage hatched = page_->scene_view->picture();
  key(Qt::Key_H);
  EXPECT_NE(page_->scene_view->picture(), hatched);
  EXPECT_FALSE(page_->model_tools->hatching->isChecked());
}

}  // namespace
}  // namespace gyre
