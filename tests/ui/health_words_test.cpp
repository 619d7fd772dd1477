// What a surface is like, and what cleaning did, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health_words.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "ui/surface_kinds.h"

namespace gyre {
namespace {

MeshHealth closedBody() {
  MeshHealth health;
  health.vertices = 100;
  health.triangles = 196;
  health.components = 1;
  health.closed = true;
  health.manifold = true;
  health.area_mm2 = 5000.0;
  health.volume_mm3 = 24500.0;
  return health;
}

TEST(HealthWords, SayWhatIsWellAndWhatIsNot) {
  MeshHealth health = closedBody();
  QString text = healthText(health);
  EXPECT_TRUE(text.contains("✓ closed, 24.50 cm³"));
  EXPECT_TRUE(text.contains("touches itself nowhere"));
  EXPECT_TRUE(text.contains("✓ one piece"));
  EXPECT_TRUE(text.contains("50.0 cm²"));
  EXPECT_FALSE(text.contains("not seen"));
  EXPECT_FALSE(text.contains("passes through itself"));  // nobody has looked
  health.self_intersections = 0;
  EXPECT_TRUE(healthText(health).contains("✓ passes through itself nowhere"));
  health.self_intersections = 7;
  EXPECT_TRUE(healthText(health).contains("⚠ passes through itself: 7 pairs"));
  health.closed = false;
  health.holes = 3;
  health.non_manifold_edges = 2;
  health.components = 4;
  health.unseen_area_mm2 = 500.0;
  text = healthText(health);
  EXPECT_TRUE(text.contains("open, rims of holes: 3"));
  EXPECT_TRUE(text.contains("touches itself at 2"));
  EXPECT_TRUE(text.contains("4 pieces"));
  EXPECT_TRUE(text.contains("10.0 %"));
}

TEST(HealthWords, TellOnlyWhatCleaningChanged) {
  CleanReport report;
  report.before = closedBody();
  report.after = report.before;
  EXPECT_EQ(cleanText(report), "This changes nothing.");
  report.steps = {{"Merge", 196, 196, {{"vertices merged", 0.0, ""}}},
                  {"Crop", 196, 96, {{"triangles removed", 100.0, ""}, {"triangles cut", 8.0, ""}}},
                  {"Fill holes", 96, 96, {{"area filled", 12.5, "mm^2"}}}};
  report.after.triangles = 96;
  report.after.closed = false;
  report.after.holes = 1;
  const QString text = cleanText(report);
  EXPECT_FALSE(text.contains("Merge"));
  EXPECT_TRUE(text.contains("Crop: triangles removed 100, triangles cut 8"));
  EXPECT_TRUE(text.contains("area filled 12.5 mm²"));
  EXPECT_TRUE(text.contains("Triangles: 196 → 96"));
  EXPECT_TRUE(text.contains("Holes: 0 → 1"));
  EXPECT_TRUE(text.contains("Volume: 24.50 cm³ → open"));
  EXPECT_FALSE(text.contains("Pieces"));
}

TEST(HealthWords, ShareOfNoAreaIsNone) { EXPECT_EQ(unseenShare({}), 0.0); }

TEST(SurfaceKinds, HaveWordsOfTheirOwn) {
  std::set<QString> names;
  for (const MeshMethod method : offeredSurfaceKinds()) {
    const SurfaceKind kind = surfaceKind(method);
    EXPECT_FALSE(kind.sentence.isEmpty()) << wordOf(method);
    EXPECT_TRUE(names.insert(kind.name).second) << wordOf(method);
  }
  EXPECT_EQ(names.size(), kMeshMethodWords.size());
  EXPECT_EQ(offeredSurfaceKinds().front(), MeshMethod::kAuto);
}

}  // namespace
}  // namespace gyre
