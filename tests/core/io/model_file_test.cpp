// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/obj.h"
#include "core/io/ply.h"
#include "core/io/stl.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(ReadMeshOrCloud, TellsMeshesFromCloudsByWhatIsInTheFile) {
  const TempDir dir;
  ASSERT_TRUE(writePly(dir / "a.ply", sampleCloud()));
  ASSERT_TRUE(writePly(dir / "b.PLY", sampleMesh()));
  ASSERT_TRUE(writeObj(dir / "c.obj", sampleMesh()));
  EXPECT_TRUE(std::holds_alternative<PointCloud>(*readMeshOrCloud(dir / "a.ply")));
  EXPECT_TRUE(std::holds_alternative<Mesh>(*readMeshOrCloud(dir / "b.PLY")));
  EXPECT_TRUE(std::holds_alternative<Mesh>(*readMeshOrCloud(dir / "c.obj")));
  ASSERT_TRUE(writeStl(dir / "d.stl", sampleMesh()));
  EXPECT_TRUE(std::holds_alternative<Mesh>(*readMeshOrCloud(dir / "d.stl")));
}

TEST(ReadMeshOrCloud, RefusesOtherEndingsAndMissingFiles) {
  EXPECT_THAT(readMeshOrCloud("duck.glb").error().what, HasSubstr(".ply, .obj or .stl"));
  EXPECT_FALSE(isReadableModel("duck.glb"));
  EXPECT_FALSE(isReadableModel("duck"));
  EXPECT_TRUE(isReadableModel("duck.Stl"));
  EXPECT_EQ(readMeshOrCloud("/nowhere/duck.ply").error().code, Error::Code::kNotFound);
}

TEST(ReadMesh, RefusesPointsWithoutASurface) {
  const TempDir dir;
  ASSERT_TRUE(writePly(dir / "a.ply", sampleCloud()));
  EXPECT_THAT(readMesh(dir / "a.ply").error().what, HasSubstr("no surface"));
}

TEST(ReadPointCloud, TakesTheVerticesOfAMesh) {
  const TempDir dir;
  ASSERT_TRUE(writePly(dir / "a.ply", sampleMesh()));
  const auto cloud = readPointCloud(dir / "a.ply");
  ASSERT_TRUE(cloud) << cloud.error().sentence();
  ASSERT_EQ(cloud->points.size(), 4U);
  EXPECT_EQ(cloud->points[3].position, sampleMesh().vertices[3].position);
  EXPECT_NEAR(cloud->points[3].sigmaMm(), 0.75, 1e-12);
}

}  // namespace
}  // namespace gyre
