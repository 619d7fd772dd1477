// Cleaning with a preview: the newest wish wins, and what is undone is what there was.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_editor.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>

#include "core/mesh/mesh_health.h"
#include "tests/support/qt_application.h"
#include "tests/support/solids.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 60000;
constexpr double kRadius_mm = 20.0;

SurfaceState ball(std::size_t longitudes) {
  SurfaceState state;
  state.mesh = std::make_shared<const Mesh>(test::ballMesh(kRadius_mm, longitudes));
  state.health = meshHealth(*state.mesh);
  state.step = "scan";
  return state;
}

// Leaves the ball within this distance of the axis: open at both ends.
CleanOptions cropTo(double radius_mm) {
  CleanOptions options;
  options.crop.radius_mm = radius_mm;
  return options;
}

double reach(const MeshPtr& mesh) { return boundsOf(*mesh).max.x(); }

class SurfaceEditorTest : public testing::Test {
 protected:
  void begin(std::size_t longitudes = 60) {
    first_ = ball(longitudes);
    editor_.begin(first_);
  }
  bool waitForPreview() {
    return QTest::qWaitFor([&] { return !editor_.busy(); }, kPatience_ms);
  }
  void preview(const CleanOptions& options) {
    editor_.preview(options);
    ASSERT_TRUE(waitForPreview());
  }
  SurfaceEditor editor_;
  SurfaceState first_;
};

TEST_F(SurfaceEditorTest, ShowsAPreviewThatIsNotYetTheSurface) {
  begin();
  QSignalSpy made(&editor_, &SurfaceEditor::previewMade);
  preview(cropTo(10.0));
  ASSERT_EQ(made.count(), 1);
  EXPECT_NEAR(reach(editor_.shown()), 10.0, 1e-9);
  EXPECT_EQ(editor_.now()->mesh, first_.mesh);
  const auto report = made.front().front().value<CleanReport>();
  EXPECT_TRUE(report.before.closed);
  EXPECT_FALSE(report.after.closed);
}

TEST_F(SurfaceEditorTest, CountsTheSelfIntersectionsOfTheSurfaceThatStays) {
  QSignalSpy known(&editor_, &SurfaceEditor::healthKnown);
  begin();
  begin(80);  // soon another: of the first nothing is told
  ASSERT_TRUE(QTest::qWaitFor([&] { return known.count() > 0; }, kPatience_ms));
  EXPECT_EQ(editor_.now()->health.self_intersections, 0U);
  preview(cropTo(10.0));
  EXPECT_FALSE(editor_.shownHealth().self_intersections);
  editor_.apply();
  ASSERT_TRUE(QTest::qWaitFor([&] { return known.count() > 1; }, kPatience_ms));
  EXPECT_EQ(editor_.now()->health.self_intersections, 0U);
  editor_.undo();
  EXPECT_EQ(editor_.now()->health.self_intersections, 0U);  // known already
  QTest::qWait(600);
  EXPECT_EQ(known.count(), 2);
}

TEST_F(SurfaceEditorTest, MakesOnlyTheNewestOfManyWishes) {
  begin(200);
  QSignalSpy made(&editor_, &SurfaceEditor::previewMade);
  for (const double radius_mm : {18.0, 16.0, 14.0, 12.0, 11.0}) editor_.preview(cropTo(radius_mm));
  ASSERT_TRUE(waitForPreview());
  EXPECT_EQ(made.count(), 1);
  EXPECT_NEAR(reach(editor_.shown()), 11.0, 1e-9);
}

TEST_F(SurfaceEditorTest, DropsAPreviewInItsMiddleAtOnce) {
  begin(300);
  CleanOptions slow;
  slow.decimate.triangles = 2000;
  slow.smooth.iterations = 500;
  editor_.preview(slow);
  QTest::qWait(50);
  QElapsedTimer clock;
  clock.start();
  editor_.dropPreview();
  EXPECT_LT(clock.elapsed(), 100);
  EXPECT_FALSE(editor_.previewing());
  QSignalSpy made(&editor_, &SurfaceEditor::previewMade);
  ASSERT_TRUE(waitForPreview());
  EXPECT_EQ(made.count(), 0);
  EXPECT_EQ(editor_.shown(), first_.mesh);
}

TEST_F(SurfaceEditorTest, AppliesWhatIsStillBeingMade) {
  begin();
  editor_.preview(cropTo(10.0));
  editor_.apply();
  ASSERT_TRUE(waitForPreview());
  EXPECT_FALSE(editor_.previewing());
  EXPECT_NEAR(reach(editor_.now()->mesh), 10.0, 1e-9);
  EXPECT_EQ(editor_.now()->step, "small pieces, crop");
}

TEST_F(SurfaceEditorTest, UndoesToTheVeryBeginningAndDoesAgain) {
  begin();
  for (const double radius_mm : {15.0, 10.0, 5.0}) {
    preview(cropTo(radius_mm));
    editor_.apply();
  }
  QSignalSpy changed(&editor_, &SurfaceEditor::stateChanged);
  editor_.undo();
  EXPECT_NEAR(reach(editor_.now()->mesh), 10.0, 1e-9);
  editor_.undo();
  editor_.undo();
  EXPECT_EQ(editor_.now()->mesh, first_.mesh);
  editor_.undo();
  EXPECT_EQ(changed.count(), 3);
  editor_.redo();
  EXPECT_NEAR(reach(editor_.now()->mesh), 15.0, 1e-9);
}

TEST_F(SurfaceEditorTest, UndoTakesThePreviewFirst) {
  begin();
  preview(cropTo(15.0));
  editor_.apply();
  preview(cropTo(5.0));
  QSignalSpy facts(&editor_, &SurfaceEditor::factsChanged);
  editor_.undo();
  EXPECT_NEAR(reach(editor_.shown()), 15.0, 1e-9);
  EXPECT_EQ(facts.back().front().value<EditFacts>().undo, "small pieces, crop");
  editor_.undo();
  EXPECT_EQ(editor_.shown(), first_.mesh);
}

TEST_F(SurfaceEditorTest, UndoesDuringAPreviewThatRuns) {
  begin(300);
  CleanOptions slow;
  slow.decimate.triangles = 2000;
  editor_.preview(slow);
  QTest::qWait(30);
  editor_.undo();
  EXPECT_FALSE(editor_.previewing());
  ASSERT_TRUE(waitForPreview());
  EXPECT_EQ(editor_.shown(), first_.mesh);
  EXPECT_EQ(editor_.now()->mesh, first_.mesh);
}

TEST_F(SurfaceEditorTest, AsksToStopTheSurfaceThatIsBeingMade) {
  begin();
  preview(cropTo(10.0));
  editor_.apply();
  editor_.noteMaking("the surface");
  QSignalSpy stop(&editor_, &SurfaceEditor::stopRequested);
  editor_.undo();
  EXPECT_EQ(stop.count(), 1);
  EXPECT_NEAR(reach(editor_.now()->mesh), 10.0, 1e-9);
  editor_.noteMaking({});
  editor_.undo();
  EXPECT_EQ(editor_.now()->mesh, first_.mesh);
}

TEST_F(SurfaceEditorTest, ShowsWhatWasBeforeThePreviewOrTheLastStep) {
  begin();
  preview(cropTo(15.0));
  editor_.setSide(EditSide::kBefore);
  EXPECT_EQ(editor_.shown(), first_.mesh);
  editor_.setSide(EditSide::kAfter);
  EXPECT_NEAR(reach(editor_.shown()), 15.0, 1e-9);
  editor_.apply();
  editor_.setSide(EditSide::kBefore);
  EXPECT_EQ(editor_.shown(), first_.mesh);
  EXPECT_NEAR(reach(editor_.now()->mesh), 15.0, 1e-9);  // looking changes nothing
}

TEST_F(SurfaceEditorTest, SaysWhyACropLeavesNothing) {
  begin();
  QSignalSpy refused(&editor_, &SurfaceEditor::previewRefused);
  CleanOptions options;
  options.crop.z_min_mm = 100.0;
  preview(options);
  ASSERT_EQ(refused.count(), 1);
  EXPECT_FALSE(refused.front().front().value<Error>().advice.empty());
  EXPECT_EQ(editor_.shown(), first_.mesh);
  editor_.apply();
  EXPECT_EQ(editor_.now()->mesh, first_.mesh);
}

TEST_F(SurfaceEditorTest, BeginsAnewWithAnotherScanInTheMiddleOfAPreview) {
  begin(300);
  CleanOptions slow;
  slow.decimate.triangles = 2000;
  editor_.preview(slow);
  QTest::qWait(30);
  const SurfaceState other = ball(20);
  editor_.begin(other);
  ASSERT_TRUE(waitForPreview());
  EXPECT_EQ(editor_.shown(), other.mesh);
  editor_.undo();
  EXPECT_EQ(editor_.shown(), other.mesh);
}

TEST_F(SurfaceEditorTest, DoesNothingWithoutASurface) {
  editor_.preview(cropTo(10.0));
  editor_.apply();
  editor_.undo();
  editor_.redo();
  EXPECT_EQ(editor_.shown(), nullptr);
  EXPECT_FALSE(editor_.busy());
}

}  // namespace
}  // namespace gyre
