// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/io/model_file.h"
#include "core/io/ply.h"
#include "tests/support/model_samples.h"
#include "tests/support/mutate.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr const char* kMeshLabAscii =
    "ply\nformat ascii 1.0\ncomment VCGLIB generated\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty uchar quality\n"
    "element vertex 4\nproperty uchar alpha\nproperty uchar blue\nproperty double z\n"
    "property double y\nproperty double x\nproperty uchar red\nproperty uchar green\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    "4 0 1 2 3 9\n3 0 1 2 9\n"
    "255 3 0.5 0 0 1 2\n255 3 0.5 0 1e0 1 2\n255 3 .5 +1 1 1 2\r\n255 3 0.5 1 0 1 2\n0 1";

TEST(ParsePly, ReadsTextInAnyOrderAndCutsPolygons) {
  const auto model = parsePly(kMeshLabAscii, "f");
  ASSERT_TRUE(model) << model.error().sentence();
  const Mesh& mesh = std::get<Mesh>(*model);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2].position, Eigen::Vector3d(1, 1, 0.5));
  EXPECT_EQ(mesh.vertices[2].rgb, (Rgb{1, 2, 3}));
  EXPECT_EQ(mesh.vertices[2].seen, 1);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
}

TEST(ParsePly, ReadsBigEndianAndColoursAsFloats) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty short y\n"
      "property uchar z\nproperty float red\nproperty ushort green\nend_header\n";
  const auto model =
      parsePly(text + std::string("\x3F\xC0\0\0\xFF\xFE\x07\x3F\x80\0\0\x80\x80", 13), "f");
  ASSERT_TRUE(model) << model.error().sentence();
  const Point& point = std::get<PointCloud>(*model).points.at(0);
  EXPECT_EQ(point.position, Eigen::Vector3d(1.5, -2, 7));
  EXPECT_EQ(point.rgb, (Rgb{255, 128, kUncoloured[2]}));
}

TEST(ParsePly, SpreadsASigmaWithoutCovarianceOverAllDirections) {
  const auto model = parsePly(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float sigma_mm\nend_header\n0 0 0 0.25\n",
      "f");
  const Point& point = std::get<PointCloud>(*model).points.at(0);
  EXPECT_NEAR(point.sigmaMm(), 0.25, 1e-12);
  EXPECT_EQ(point.rgb, kUncoloured);
}

TEST(ParsePly, TellsWhatIsWrong) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string ascii = "ply\nformat ascii 1.0\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string one = ascii + "element vertex 1\n" + xyz;
  const std::pair<std::string, std::string> cases[] = {
      {ascii + "end_header\n", "no points"},
      {ascii + "element vertex 0\n" + xyz + "end_header\n", "no points"},
      {ascii + "element vertex 1\nproperty float x\nend_header\n1\n", "without a position"},
      {one + "end_header\n0 0 nan\n", "no number"},
      {one + "end_header\n0 0 inf\n", "no number"},
      {one + "end_header\n0 0 1e999\n", "damaged"},
      {one + "end_header\n0 0 zero\n", "damaged"},
      {one + "end_header\n0 0 1x\n", "damaged"},
      {one + "end_header\n0 0     \n", "damaged"},
      {one + faces + "0 0 0\n3 0 0 1\n", "does not exist"},
      {one + faces + "0 0 0\n3 0 0 -1\n", "does not exist"},
      {one + faces + "0 0 0\n3 0 0 4294967296\n", "does not exist"},
      {one + faces + "0 0 0\n3 0 0\n", "damaged"},
      {one + faces + "0 0 0\n-3 0 0 0\n", "damaged"},
      {one + faces + "0 0 0\n4000000000 0 0 0\n", "damaged"},
  };
  for (const auto& [text, problem] : cases) {
    const auto model = parsePly(text, "duck.ply");
    ASSERT_FALSE(model) << text;
    EXPECT_EQ(model.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(model.error().what, HasSubstr("duck.ply"));
    EXPECT_THAT(model.error().what, HasSubstr(problem)) << text;
  }
}

TEST(ParsePly, RefusesABinaryFileCutAnywhere) {
  const std::string bytes = plyBytes(sampleMesh());
  ASSERT_TRUE(parsePly(bytes, "f"));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(parsePly(std::string_view(bytes).substr(0, length), "f")) << length;
  }
}

TEST(ParsePly, SurvivesDamage) {
  const std::string samples[] = {plyBytes(sampleMesh()), plyBytes(sampleCloud()), kMeshLabAscii};
  for (const std::string& sample : samples) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      const auto model = parsePly(mutated(sample, seed), "f");
      if (!model || std::holds_alternative<PointCloud>(*model)) continue;
      const Mesh& mesh = std::get<Mesh>(*model);
      for (const Triangle& triangle : mesh.triangles) {
        ASSERT_LT(*std::max_element(triangle.begin(), triangle.end()), mesh.vertices.size());
      }
    }
  }
}

}  // namespace
}  // namespace gyre
