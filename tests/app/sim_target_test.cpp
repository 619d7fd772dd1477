// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sim_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/rig.h"
#include "core/base/clock.h"
#include "core/calib/targets/standard_targets.h"
#include "core/io/target_file.h"
#include "core/sim/rig_json.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

RigOptions small() {
  RigOptions options;
  options.sim = atImageWidth(RigSettings{}, 160);
  options.sim_speed = 50.0;
  return options;
}

TEST(SimulatedTarget, StandsOnTheTableByItsWord) {
  auto rig = openRig("sim:target:coded-cube", "sim", small(), {});
  ASSERT_TRUE(rig) << rig.error().sentence();
  ASSERT_NE(rig->room->renderer->target(), nullptr);
  EXPECT_EQ(rig->room->renderer->target()->truth().name, "coded-cube");
  auto usual = openRig("sim:target", "sim", small(), {});
  ASSERT_TRUE(usual) << usual.error().sentence();
  EXPECT_EQ(usual->room->renderer->target()->truth().name, "wedge");
}

TEST(SimulatedTarget, LiesUnderAnObjectWhenTheRigSaysSo) {
  RigOptions options = small();
  options.sim.target = "ring";
  auto rig = openRig("sim:cube", "sim", options, {});
  ASSERT_TRUE(rig) << rig.error().sentence();
  EXPECT_EQ(rig->room->renderer->rig().object, "cube");
  ASSERT_NE(rig->room->renderer->target(), nullptr);
  EXPECT_FALSE(rig->room->renderer->object().mesh().vertices.empty());
}

// A rig that was kept as text sees the same world again.
TEST(SimulatedTarget, IsTheSameFromAFileAndFromTheRigsRecord) {
  const TempDir dir;
  ASSERT_TRUE(writeTarget(dir / "t.json", standardTarget("flat")->target));
  RigSettings rig = small().sim;
  placeObject("target:" + (dir / "t.json").string(), rig);
  EXPECT_EQ(rig.object, "target");
  const auto again = rigFromJson(rigToJson(rig));
  ASSERT_TRUE(again) << again.error().sentence();
  const auto first = simulatedTarget(rig);
  const auto second = simulatedTarget(*again);
  ASSERT_TRUE(first && second);
  const Frame before = Renderer(rig, *first).render(77, TableLoad::kObject);
  const Frame after = Renderer(*again, *second).render(77, TableLoad::kObject);
  EXPECT_TRUE(
      std::equal(before.image_bgr.datastart, before.image_bgr.dataend, after.image_bgr.datastart));
}

TEST(SimulatedTarget, KeepsAFilesPathWhole) {
  RigSettings rig;
  placeObject("target:board.json", rig);
  EXPECT_TRUE(rig.target.starts_with("/"));
  EXPECT_TRUE(rig.target.ends_with("board.json"));
  placeObject("target:cube", rig);
  EXPECT_EQ(rig.target, "cube");
}

TEST(SimulatedTarget, TellsWhatItCannotShow) {
  const auto missing = openRig("sim:target:/nowhere/t.json", "sim", small(), {});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().sentence(), testing::HasSubstr("/nowhere/t.json"));
  const TempDir dir;
  Target odd = standardTarget("flat")->target;
  odd.corners[3].position_in_target.x() += 0.4;
  ASSERT_TRUE(writeTarget(dir / "odd.json", odd));
  const auto uneven = openRig("sim:target:" + (dir / "odd.json").string(), "sim", small(), {});
  ASSERT_FALSE(uneven);
  EXPECT_THAT(uneven.error().sentence(), testing::HasSubstr("evenly spaced"));
}

}  // namespace
}  // namespace gyre
