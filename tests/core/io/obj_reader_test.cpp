// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/model_file.h"
#include "core/io/obj.h"
#include "tests/support/model_samples.h"
#include "tests/support/mutate.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr const char* kBlender =
    "# Blender\r\nmtllib a.mtl\no Cube\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 1 0 0\nv 0 1 0 1.0 0 1 0\n"
    "vt 0 0\nvn 0 0 2\nusemtl a\ns off\nf 1/1/1 2/1/1 3/1/1 \\\n 4/1/1\nf -4//-1 -3//1 -2//1\n"
    "f 1/1 2/1 4/1 # comment\nl 1 2\n";

TEST(ParseObj, ReadsEveryWayToNameACorner) {
  const auto model = parseObj(kBlender, "f");
  ASSERT_TRUE(model) << model.error().sentence();
  const Mesh& mesh = std::get<Mesh>(*model);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(mesh.vertices[3].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(mesh.vertices[1].rgb, kUncoloured);
  EXPECT_EQ(mesh.vertices[2].rgb, (Rgb{255, 0, 0}));
  EXPECT_EQ(mesh.vertices[3].rgb, (Rgb{0, 255, 0}));
}

TEST(ParseObj, MakesACloudOfPointsWithoutFaces) {
  EXPECT_EQ(std::get<PointCloud>(*parseObj("v 1 2 3\nv 4 5 6", "f")).points.size(), 2U);
}

TEST(ParseObj, TellsWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "no points"},
      {"# nothing\n", "no points"},
      {std::string("v 1 2 3\n\0", 9), "no OBJ"},
      {"v 1 2\n", "line 1"},
      {"v 1 2 3\nv 1 2 x\n", "line 2"},
      {"v 1 2 nan\n", "no number"},
      {"v 0 0 0 nan 0 0\n", "line 1"},
      {"v 0 0 0\nf 1 1\n", "line 2"},
      {"v 0 0 0\nf 0 1 1\n", "line 2"},
      {"v 0 0 0\nf -2 1 1\n", "line 2"},
      {"v 0 0 0\nf 1 1 2\n", "does not exist"},
      {"v 0 0 0\nf 1 1 99999999999999999999\n", "line 2"},
      {"v 0 0 0\nf 1// 1// 1//\n", "line 2"},
      {"v 0 0 0\n\\\n\nvn 1 2\n", "line 4"},
  };
  for (const auto& [text, problem] : cases) {
    const auto model = parseObj(text, "duck.obj");
    ASSERT_FALSE(model) << text;
    EXPECT_THAT(model.error().what, HasSubstr("duck.obj"));
    EXPECT_THAT(model.error().what, HasSubstr(problem)) << text;
  }
}

TEST(ParseObj, SurvivesDamage) {
  for (const std::string& sample : {std::string(kBlender), objText(sampleMesh())}) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      const auto model = parseObj(mutated(sample, seed), "f");
      EXPECT_TRUE(model || !model.error().what.empty());
    }
  }
}

}  // namespace
}  // namespace gyre
