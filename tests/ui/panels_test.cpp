// The small panels, driven as a person would: surface, export, steps, log, and the drawn parts.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>

#include "tests/support/qt_application.h"
#include "ui/export_panel.h"
#include "ui/log_panel.h"
#include "ui/mesh_panel.h"
#include "ui/meter.h"
#include "ui/step_list.h"
#include "ui/target_drawing.h"

namespace gyre {
namespace {

QString textOf(const QWidget& widget) {
  QStringList texts;
  for (const QLabel* label : widget.findChildren<QLabel*>()) texts.append(label->text());
  return texts.join('\n');
}

bool anyEnabled(const QWidget& widget) {
  for (const QPushButton* button : widget.findChildren<QPushButton*>()) {
    if (button->isEnabled()) return true;
  }
  return false;
}

QImage pictureOf(QWidget& widget, const QSize& size) {
  widget.resize(size);
  return widget.grab().toImage();
}

TEST(ExportPanel, OffersOnlyWhatThereIs) {
  ExportPanel panel;
  EXPECT_FALSE(anyEnabled(panel));
  panel.showAvailable(1000, 0);
  EXPECT_TRUE(anyEnabled(panel));
  int enabled = 0;
  for (const QPushButton* button : panel.findChildren<QPushButton*>()) {
    enabled += button->isEnabled() ? 1 : 0;
  }
  EXPECT_EQ(enabled, 1);  // points, and no surface
  panel.showWritten("/somewhere/mesh.obj");
  EXPECT_TRUE(textOf(panel).contains("/somewhere/mesh.obj"));
}

void press(QWidget& parent, const QString& text) {
  for (QPushButton* button : parent.findChildren<QPushButton*>()) {
    if (button->text() == text && button->isEnabled()) return button->click();
  }
  ADD_FAILURE() << "no button " << text.toStdString();
}

// Types a name into the dialog that is open and saves.
void saveAs(QWidget& panel, const QString& name) {
  auto* dialog = panel.findChild<QFileDialog*>();
  ASSERT_NE(dialog, nullptr);
  auto* line = dialog->findChild<QLineEdit*>();
  ASSERT_NE(line, nullptr);
  line->selectAll();
  QTest::keyClicks(line, name);
  QTest::keyClick(line, Qt::Key_Return);
}

TEST(ExportPanel, AsksForTheFileOfEachFormatAndCompletesItsName) {
  const QTemporaryDir folder;
  ExportPanel panel;
  panel.setFolder(folder.path());
  panel.showAvailable(1000, 2000);
  QSignalSpy wanted(&panel, &ExportPanel::meshExportRequested);
  for (const QString format : {"PLY", "OBJ", "STL", "3MF", "GLB"}) {
    press(panel, "Surface as " + format + "…");
    saveAs(panel, "cup");
    ASSERT_EQ(wanted.count(), 1) << format.toStdString();
    EXPECT_EQ(wanted.takeFirst().at(0).toString(), folder.filePath("cup." + format.toLower()));
    QTest::qWait(1);  // the dialog goes
  }
  QSignalSpy points(&panel, &ExportPanel::pointsExportRequested);
  press(panel, "Points as PLY…");
  saveAs(panel, "cloud.ply");
  ASSERT_EQ(points.count(), 1);
  EXPECT_EQ(points.front().at(0).toString(), folder.filePath("cloud.ply"));
}

TEST(ExportPanel, WritesNothingWhenThePersonThinksBetterOfIt) {
  ExportPanel panel;
  panel.showAvailable(1000, 2000);
  QSignalSpy wanted(&panel, &ExportPanel::meshExportRequested);
  press(panel, "Surface as STL…");
  panel.findChild<QFileDialog*>()->reject();
  EXPECT_EQ(wanted.count(), 0);
}

TEST(ExportPanel, OpensTheFileThatWasWrittenLast) {
  ExportPanel panel;
  panel.showAvailable(1000, 2000);
  QSignalSpy opened(&panel, &ExportPanel::openRequested);
  for (QPushButton* button : panel.findChildren<QPushButton*>()) {
    const bool opens = button->text() == "Open in its program";
    EXPECT_FALSE(opens && button->isEnabled());
  }
  panel.showWritten("/somewhere/mesh.obj");
  panel.showWritten("/somewhere/mesh.stl");
  press(panel, "Open in its program");
  ASSERT_EQ(opened.count(), 1);
  EXPECT_EQ(opened.front().at(0).toString(), "/somewhere/mesh.stl");
}

void chooseKind(MeshPanel& panel, MeshMethod kind) {
  auto* kinds = panel.findChild<QComboBox*>();
  kinds->setCurrentIndex(kinds->findData(static_cast<int>(kind)));
}

TEST(MeshPanel, OffersEveryKindAndExplainsIt) {
  MeshPanel panel;
  panel.showPoints(1000);
  std::set<QString> explained;
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  for (const auto& [kind, word] : kMeshMethodWords) {
    chooseKind(panel, kind);
    explained.insert(textOf(panel));
    press(panel, "Build the surface");
    EXPECT_EQ(wanted.back().at(0).value<MeshMethod>(), kind) << word;
  }
  EXPECT_EQ(explained.size(), kMeshMethodWords.size());
}

TEST(MeshPanel, ShowsTheKindThatAnUndoneStepHadWithoutAskingForIt) {
  MeshPanel panel;
  panel.showPoints(1000);
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  panel.showSurface(MeshMethod::kAlpha, 2.5);
  EXPECT_FALSE(wanted.wait(150));
  EXPECT_EQ(panel.findChild<QComboBox*>()->currentData().toInt(),
            static_cast<int>(MeshMethod::kAlpha));
  EXPECT_DOUBLE_EQ(panel.findChild<QDoubleSpinBox*>()->value(), 2.5);
  panel.findChild<QDoubleSpinBox*>()->setValue(3.0);  // and the slider is alive again
  EXPECT_TRUE(wanted.wait(1000));
}

TEST(MeshPanel, MakesNoSurfaceWithoutPoints) {
  MeshPanel panel;
  EXPECT_FALSE(anyEnabled(panel));
  panel.showPoints(1000);
  EXPECT_TRUE(anyEnabled(panel));
  panel.showPoints(0);
  EXPECT_FALSE(anyEnabled(panel));
}

TEST(MeshPanel, AsksForTheGapSizeThatWasSet) {
  MeshPanel panel;
  panel.showPhase(ScanPhase::kDone);
  panel.showPoints(1000);
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  auto* gap = panel.findChild<QDoubleSpinBox*>();
  ASSERT_NE(gap, nullptr);
  chooseKind(panel, MeshMethod::kAlpha);
  gap->setValue(2.5);
  for (QPushButton* button : panel.findChildren<QPushButton*>()) button->click();
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted.front().at(0).value<MeshMethod>(), MeshMethod::kAlpha);
  EXPECT_DOUBLE_EQ(wanted.front().at(1).toDouble(), 2.5);
}

TEST(MeshPanel, MakesAClosedBodyUnlessAskedOtherwise) {
  MeshPanel panel;
  panel.showPhase(ScanPhase::kDone);
  panel.showPoints(1000);
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  EXPECT_FALSE(panel.findChild<QDoubleSpinBox*>()->isEnabled());
  for (QPushButton* button : panel.findChildren<QPushButton*>()) button->click();
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted.front().at(0).value<MeshMethod>(), MeshMethod::kAuto);
}

TEST(MeshPanel, FollowsTheSliderOnceASurfaceWithGapsIsShown) {
  MeshPanel panel;
  panel.showPhase(ScanPhase::kDone);
  panel.showPoints(1000);
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  chooseKind(panel, MeshMethod::kAlpha);
  auto* slider = panel.findChild<QSlider*>();
  slider->setValue(80);
  EXPECT_FALSE(wanted.wait(150));
  for (QPushButton* button : panel.findChildren<QPushButton*>()) button->click();
  slider->setValue(120);
  slider->setValue(130);
  ASSERT_TRUE(wanted.wait(1000));
  ASSERT_EQ(wanted.count(), 2);  // the button's, and one for both moves
  EXPECT_NEAR(wanted.back().at(1).toDouble(), panel.findChild<QDoubleSpinBox*>()->value(), 1e-9);
  EXPECT_GT(wanted.back().at(1).toDouble(), wanted.front().at(1).toDouble());
}

TEST(MeshPanel, DoesNotMakeASurfaceInTheMiddleOfAScan) {
  MeshPanel panel;
  panel.showPhase(ScanPhase::kScanning);
  panel.showPoints(1000);
  QSignalSpy wanted(&panel, &MeshPanel::meshRequested);
  for (QPushButton* button : panel.findChildren<QPushButton*>()) button->click();
  EXPECT_EQ(wanted.count(), 0);
}

TEST(MeshPanel, TellsWhatTheSurfaceIsLike) {
  MeshPanel panel;
  MeshHealth health;
  health.vertices = 4000;
  health.triangles = 7654;
  health.components = 1;
  health.boundary_edges = 12;
  health.manifold = true;
  panel.showHealth(health);
  const QString open = textOf(panel);
  EXPECT_TRUE(open.contains("7654") || open.contains("7,654") || open.contains("7\u202f654"))
      << open.toStdString();
  health.boundary_edges = 0;
  health.closed = true;
  panel.showHealth(health);
  EXPECT_NE(textOf(panel), open);
  panel.showNoMesh();
  EXPECT_FALSE(textOf(panel).contains("7654"));
}

TEST(StepList, TellsWhichStepWasChosenByMouseAndKey) {
  StepList list;
  list.resize(300, 320);
  list.show();
  QSignalSpy chosen(&list, &StepList::stepChosen);
  const auto rows = list.findChildren<StepRow*>();
  ASSERT_EQ(rows.size(), static_cast<qsizetype>(kStepCount));
  QTest::mouseClick(rows[2], Qt::LeftButton);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen.front().front().value<Step>(), Step::kCalibrate);
  rows[4]->setFocus();
  QTest::keyClick(rows[4], Qt::Key_Space);
  ASSERT_EQ(chosen.count(), 2);
  EXPECT_EQ(chosen.back().front().value<Step>(), Step::kScan);
}

TEST(StepList, DrawsEachStateWithASignOfItsOwn) {
  StepRow row(2, "Calibrate");
  std::vector<QImage> drawn;
  for (const StepState state :
       {StepState::kTodo, StepState::kNow, StepState::kDone, StepState::kAttention}) {
    row.setState(state);
    drawn.push_back(pictureOf(row, {240, 46}).convertToFormat(QImage::Format_Grayscale8));
  }
  // Without the colours they still differ.
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (std::size_t j = i + 1; j < drawn.size(); ++j) EXPECT_NE(drawn[i], drawn[j]) << i << j;
  }
}

TEST(Meter, ShowsHowMuchAndKeepsItsState) {
  Meter meter("Sharpness");
  meter.show(0.2, MeterState::kBad, "20 %");
  const QImage little = pictureOf(meter, {240, 38});
  EXPECT_EQ(meter.state(), MeterState::kBad);
  meter.show(0.9, MeterState::kGood, "90 %");
  EXPECT_EQ(meter.state(), MeterState::kGood);
  EXPECT_NE(pictureOf(meter, {240, 38}), little);
}

TEST(LogPanel, KeepsEachLineInItsOrder) {
  LogPanel panel;
  panel.addLine("first");
  panel.addLine("second");
  const QString text = panel.findChild<QPlainTextEdit*>()->toPlainText();
  ASSERT_TRUE(text.contains("first"));
  EXPECT_LT(text.indexOf("first"), text.indexOf("second"));
}

TEST(TargetDrawing, RingsTheCornerThatIsAskedFor) {
  TargetSketch sketch;
  sketch.faces.emplace_back().outline = {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
  for (int i = 0; i < 6; ++i) {
    sketch.corners.push_back({i, {0.2 + 0.1 * i, 0.5}});
    sketch.to_click.push_back(i);
  }
  TargetDrawing drawing;
  drawing.ask(sketch, 0);
  const QImage first = pictureOf(drawing, {220, 180});
  drawing.ask(sketch, 1);
  EXPECT_NE(pictureOf(drawing, {220, 180}), first);
  drawing.ask({}, 0);  // nothing to draw is no harm
  EXPECT_FALSE(pictureOf(drawing, {220, 180}).isNull());
}

}  // namespace
}  // namespace gyre
