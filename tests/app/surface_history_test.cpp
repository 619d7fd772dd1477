// Undo and redo of surfaces as values: what is there, what is let go.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_history.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/solids.h"

namespace gyre {
namespace {

SurfaceState state(const std::string& step, std::size_t longitudes = 8) {
  SurfaceState made;
  Mesh ball = test::ballMesh(10.0, longitudes);
  made.mesh = std::make_shared<const Mesh>(std::move(ball));
  made.step = step;
  return made;
}

std::size_t bytesOf(const Mesh& mesh) {
  return mesh.vertices.capacity() * sizeof(MeshVertex) +
         mesh.triangles.capacity() * sizeof(Triangle);
}

TEST(SurfaceHistory, HasNothingToUndoAtItsBeginning) {
  SurfaceHistory history;
  EXPECT_EQ(history.now(), nullptr);
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
  history.begin(state("scan"));
  EXPECT_EQ(history.now()->step, "scan");
  EXPECT_EQ(history.before(), nullptr);
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
}

TEST(SurfaceHistory, GoesBackToTheVeryMeshOfTheBeginningAndForthAgain) {
  SurfaceHistory history;
  const SurfaceState first = state("scan");
  const Mesh copy = *first.mesh;
  history.begin(first);
  for (int i = 0; i < 30; ++i) history.add(state("step " + std::to_string(i)));
  const MeshPtr last = history.now()->mesh;
  int steps = 0;
  while (history.undo()) ++steps;
  EXPECT_EQ(steps, 30);
  EXPECT_EQ(history.now()->mesh, first.mesh);
  ASSERT_EQ(history.now()->mesh->triangles, copy.triangles);
  ASSERT_EQ(history.now()->mesh->vertices.size(), copy.vertices.size());
  for (std::size_t i = 0; i < copy.vertices.size(); ++i) {
    EXPECT_EQ(history.now()->mesh->vertices[i].position, copy.vertices[i].position) << i;
  }
  EXPECT_EQ(history.next()->step, "step 0");
  while (history.redo()) continue;
  EXPECT_EQ(history.now()->mesh, last);
}

TEST(SurfaceHistory, ForgetsWhatWasUndoneWhenAnotherStepIsMade) {
  SurfaceHistory history;
  history.begin(state("scan"));
  history.add(state("crop"));
  history.add(state("smooth"));
  history.undo();
  history.add(state("reduce"));
  EXPECT_FALSE(history.redo());
  EXPECT_EQ(history.now()->step, "reduce");
  EXPECT_EQ(history.before()->step, "crop");
}

TEST(SurfaceHistory, ReplacesTheStepThatIsBeingDragged) {
  SurfaceHistory history;
  history.begin(state("scan"));
  history.replace(state("gap size 2 mm"));  // the first is never replaced
  EXPECT_EQ(history.before()->step, "scan");
  history.replace(state("gap size 3 mm"));
  EXPECT_EQ(history.now()->step, "gap size 3 mm");
  EXPECT_EQ(history.before()->step, "scan");
}

TEST(SurfaceHistory, LetsTheOldestGoBeyondItsBoundButNeverTheBeginning) {
  const std::size_t one = bytesOf(*state("one").mesh);
  SurfaceHistory history(4 * one);
  const SurfaceState first = state("scan");
  history.begin(first);
  for (int i = 0; i < 10; ++i) {
    history.add(state("step " + std::to_string(i)));
    EXPECT_LE(history.bytes(), 4 * one) << i;
  }
  EXPECT_EQ(history.letGo(), 7U);
  EXPECT_EQ(history.now()->step, "step 9");
  EXPECT_EQ(history.before()->step, "step 8");
  int steps = 0;
  while (history.undo()) ++steps;
  EXPECT_EQ(steps, 3);
  EXPECT_EQ(history.now()->mesh, first.mesh);
}

TEST(SurfaceHistory, KeepsTheBeginningTheLastAndTheOneBeforeHoweverLarge) {
  SurfaceHistory history(1);
  const SurfaceState first = state("scan", 40);
  history.begin(first);
  for (int i = 0; i < 5; ++i) history.add(state("step " + std::to_string(i), 40));
  EXPECT_EQ(history.before()->step, "step 3");
  ASSERT_TRUE(history.undo());
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.now()->mesh, first.mesh);
  EXPECT_FALSE(history.undo());
}

TEST(SurfaceHistory, CountsAMeshThatIsSharedOnce) {
  SurfaceHistory history;
  const SurfaceState first = state("scan");
  history.begin(first);
  SurfaceState same = first;
  same.step = "nothing";
  history.add(same);
  EXPECT_EQ(history.bytes(), bytesOf(*first.mesh));
}

TEST(SurfaceHistory, BeginsAnewWithAnotherScan) {
  SurfaceHistory history;
  history.begin(state("scan"));
  history.add(state("crop"));
  history.begin(state("other"));
  EXPECT_FALSE(history.undo());
  EXPECT_EQ(history.now()->step, "other");
  history.clear();
  EXPECT_EQ(history.now(), nullptr);
  history.add(state("surface"));  // the first surface of a scan that had none
  EXPECT_EQ(history.before(), nullptr);
}

}  // namespace
}  // namespace gyre
