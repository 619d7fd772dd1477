// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/foreign_model.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(WriteModel, WritesWhatTheEndingAsksForAndOthersReadIt) {
  const TempDir dir;
  const Bounds truth = boundsOf(sampleMesh());
  for (const char* name : {"a.ply", "b.OBJ", "c.stl", "d.3mf", "e.GLB"}) {
    ASSERT_TRUE(checkModelEnding(dir / name)) << name;
    const auto written = writeModel(dir / name, sampleMesh());
    ASSERT_TRUE(written) << written.error().sentence();
    if (name[0] == 'd') continue;  // assimp 5.2 takes lib3mf's packages for empty: three_mf_test
    const test::ForeignModel foreign = test::readByAssimp(dir / name);
    EXPECT_EQ(foreign.triangles.size(), 4U) << name;
    const double unit_mm = name[0] == 'e' ? 1000.0 : 1.0;
    EXPECT_NEAR(unit_mm * foreign.bounds.diagonal(), truth.diagonal(), 1e-3) << name;
  }
}

TEST(WriteModel, KeepsThePlatesFrameInPlyAndObj) {
  const TempDir dir;
  const Mesh egg = test::hoveringEgg();
  for (const char* name : {"a.ply", "a.obj"}) {
    ASSERT_TRUE(writeModel(dir / name, egg));
    const test::ForeignModel foreign = test::readByAssimp(dir / name);
    EXPECT_NEAR(foreign.bounds.min.z(), 0.4, 1e-6) << name;
    ASSERT_EQ(foreign.triangles.size(), egg.triangles.size()) << name;
    for (std::size_t i = 0; i < egg.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const MeshVertex& vertex = egg.vertices[egg.triangles[i][k]];
        const test::ForeignCorner& corner = foreign.triangles[i][k];
        EXPECT_LT((corner.position - vertex.position).norm(), 2e-6);
        for (int channel = 0; channel < 3; ++channel) {
          EXPECT_NEAR(255.0 * corner.colour[channel], vertex.rgb[static_cast<std::size_t>(channel)],
                      0.02);  // OBJ has four digits
        }
      }
    }
  }
}

TEST(MovedAlongZ, TellsHowFarAMeshIsMovedToStandOnTheBed) {
  const Mesh egg = test::hoveringEgg();
  for (const char* name : {"a.stl", "a.3MF", "a.glb"}) {
    EXPECT_NEAR(movedAlongZ_mm(name, egg), -0.4, 1e-12) << name;
  }
  EXPECT_EQ(movedAlongZ_mm("a.ply", egg), 0.0);
  EXPECT_EQ(movedAlongZ_mm("a.obj", egg), 0.0);
  EXPECT_EQ(movedAlongZ_mm("a.stl", Mesh{}), 0.0);
}

TEST(WriteModel, SaysWhichEndingsItKnows) {
  const TempDir dir;
  for (const char* name : {"a", "a.step", "a.gltf"}) {
    const auto written = writeModel(dir / name, sampleMesh());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().sentence(), checkModelEnding(dir / name).error().sentence());
    EXPECT_THAT(written.error().what, HasSubstr(name));
    EXPECT_THAT(written.error().advice, HasSubstr(".ply, .obj, .stl, .3mf or .glb"));
    EXPECT_FALSE(std::filesystem::exists(dir / name));
  }
}

}  // namespace
}  // namespace gyre
