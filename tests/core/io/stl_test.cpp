// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/stl.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/io/model_file.h"
#include "core/io/standing_mesh.h"
#include "tests/support/foreign_model.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr double kFloat_mm = 2e-6;  // half a step of a float below 32 mm is 1e-6

TEST(WriteStl, IsReadByOthersInMillimetresStandingOnTheBed) {
  const TempDir dir;
  const Mesh egg = test::hoveringEgg();
  ASSERT_TRUE(writeStl(dir / "Ei ä.stl", egg));
  const test::ForeignModel foreign = test::readByAssimp(dir / "Ei ä.stl");
  const auto standing = standingMesh(egg);
  ASSERT_EQ(foreign.triangles.size(), standing->triangles.size());
  EXPECT_EQ(foreign.bounds.min.z(), 0.0);
  EXPECT_LT((foreign.bounds.min - boundsOf(*standing).min).norm(), kFloat_mm);
  EXPECT_LT((foreign.bounds.max - boundsOf(*standing).max).norm(), kFloat_mm);
  for (std::size_t i = 0; i < foreign.triangles.size(); ++i) {
    const auto& [a, b, c] = foreign.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& ours = standing->vertices[standing->triangles[i][k]];
      EXPECT_LT((foreign.triangles[i][k].position - ours.position).norm(), kFloat_mm);
    }
    const Eigen::Vector3d outward = (b.position - a.position).cross(c.position - a.position);
    EXPECT_GT(a.normal.dot(outward.normalized()), 0.999);
  }
}

TEST(WriteStl, IsReadBackConnected) {
  const TempDir dir;
  ASSERT_TRUE(writeStl(dir / "a.STL", sampleMesh()));
  const auto back = readMesh(dir / "a.STL");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->vertices.size(), 4U);
  EXPECT_EQ(back->triangles.size(), 4U);
}

TEST(StlBytes, IsBinaryOfTheKnownLength) {
  const auto bytes = stlBytes(sampleMesh());
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->size(), 84U + 50U * 4U);
  EXPECT_FALSE(bytes->starts_with("solid"));
}

TEST(WriteStl, SaysWhyItCannot) {
  EXPECT_EQ(writeStl("/nowhere/a.stl", sampleMesh()).error().code, Error::Code::kNotFound);
  EXPECT_EQ(writeStl("/nowhere/a.stl", Mesh{}).error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
