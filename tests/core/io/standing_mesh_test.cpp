// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/standing_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/foreign_model.h"
#include "tests/support/model_samples.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(StandingMesh, StandsOnTheBedAndIsNotMovedSideways) {
  const auto standing = standingMesh(test::hoveringEgg());
  ASSERT_TRUE(standing) << standing.error().sentence();
  const Bounds bounds = boundsOf(*standing);
  EXPECT_EQ(bounds.min.z(), 0.0);
  EXPECT_NEAR(bounds.max.z(), 24.0, 1e-12);
  EXPECT_NEAR(0.5 * (bounds.min.x() + bounds.max.x()), 11.5, 1e-12);
  EXPECT_NEAR(0.5 * (bounds.min.y() + bounds.max.y()), -3.25, 1e-12);
}

TEST(StandingMesh, RaisesWhatNoiseTookBelowThePlatter) {
  Mesh mesh = sampleMesh();
  mesh.vertices[1].position.z() = -0.03;
  EXPECT_EQ(boundsOf(*standingMesh(mesh)).min.z(), 0.0);
  EXPECT_EQ(standingMesh(mesh)->vertices[0].position.z(), 0.03);
}

TEST(StandingMesh, LeavesAMeshAloneWhoseBaseLiesOnThePlatter) {
  const Mesh mesh = sampleMesh();
  const auto standing = standingMesh(mesh);
  ASSERT_TRUE(standing);
  ASSERT_EQ(standing->triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshVertex& before = mesh.vertices[mesh.triangles[i][k]];
      const MeshVertex& after = standing->vertices[standing->triangles[i][k]];
      EXPECT_EQ(after.position, before.position);
      EXPECT_EQ(after.normal, before.normal);
      EXPECT_EQ(after.rgb, before.rgb);
    }
  }
}

TEST(StandingMesh, LeavesOutWhatIsNoSurface) {
  const Mesh mesh = test::hoveringEgg();
  const auto standing = standingMesh(mesh);
  EXPECT_EQ(standing->vertices.size() + 1, mesh.vertices.size());
  EXPECT_EQ(standing->triangles.size() + 1, mesh.triangles.size());
}

TEST(StandingMesh, GivesEveryVertexAUnitNormal) {
  Mesh mesh = sampleMesh();
  mesh.vertices[0].normal.setZero();
  mesh.vertices[1].normal *= 3.0;
  mesh.vertices[2].normal[0] = std::numeric_limits<double>::quiet_NaN();
  const auto standing = standingMesh(mesh);
  for (const MeshVertex& vertex : standing->vertices) {
    EXPECT_NEAR(vertex.normal.norm(), 1.0, 1e-12);
  }
  for (MeshVertex& vertex : mesh.vertices) vertex.position.setZero();
  for (MeshVertex& vertex : mesh.vertices) vertex.normal.setZero();
  EXPECT_EQ(standingMesh(mesh)->vertices[0].normal, Eigen::Vector3d::UnitZ());
}

TEST(StandingMesh, SaysWhatCannotBeWritten) {
  EXPECT_THAT(standingMesh(Mesh{}).error().what, HasSubstr("no triangle"));
  Mesh mesh = sampleMesh();
  for (const double nowhere : {std::numeric_limits<double>::quiet_NaN(), 1e39, -2e6}) {
    mesh.vertices[2].position.y() = nowhere;
    EXPECT_THAT(standingMesh(mesh).error().what, HasSubstr("nowhere"));
  }
  mesh.triangles = {{1, 1, 2}};
  EXPECT_THAT(standingMesh(mesh).error().what, HasSubstr("no triangle"));
  EXPECT_FALSE(standingMesh(mesh).error().advice.empty());
}

}  // namespace
}  // namespace gyre
