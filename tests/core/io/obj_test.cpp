// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/model_file.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(WriteObj, GivesBackTheMesh) {
  const TempDir dir;
  const Mesh mesh = sampleMesh();
  ASSERT_TRUE(writeObj(dir / "Ente ä.obj", mesh));
  const auto back = readMesh(dir / "Ente ä.obj");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->triangles, mesh.triangles);
  ASSERT_EQ(back->vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(back->vertices[i].position, mesh.vertices[i].position);
    EXPECT_EQ(back->vertices[i].rgb, mesh.vertices[i].rgb);
    EXPECT_LT((back->vertices[i].normal - mesh.vertices[i].normal).norm(), 1e-7);
  }
}

TEST(ObjText, BringsEachOfTheColourLevelsBack) {
  Mesh mesh = sampleMesh();
  for (int level = 0; level < 256; ++level) {
    mesh.vertices[1].rgb[1] = static_cast<std::uint8_t>(level);
    const auto back = parseObj(objText(mesh), "f");
    EXPECT_EQ(std::get<Mesh>(*back).vertices[1].rgb[1], level);
  }
}

TEST(ObjText, WritesVerticesAndFacesAsTheFieldReadsThem) {
  Mesh mesh = sampleMesh();
  EXPECT_THAT(objText(mesh), HasSubstr("\nv 1.5 0 0 0.0039 0.302 1\n"));
  EXPECT_THAT(objText(mesh), HasSubstr("\nf 1//1 3//3 2//2\n"));
  mesh.vertices[0].normal.setZero();
  EXPECT_THAT(objText(mesh), HasSubstr("\nf 1 3 2\n"));
  EXPECT_THAT(objText(mesh), Not(HasSubstr("vn")));
}

}  // namespace
}  // namespace gyre
