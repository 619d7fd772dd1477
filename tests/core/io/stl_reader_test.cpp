// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/io/little_endian.h"
#include "core/io/model_file.h"
#include "core/io/stl.h"
#include "tests/support/model_samples.h"
#include "tests/support/mutate.h"

namespace gyre {
namespace {

using testing::HasSubstr;

// Two triangles of a square, as CAD programs write it, and a solid with a polygon.
constexpr const char* kText =
    "solid square of 2\r\n"
    "  facet normal 0 0 1\r\n    outer loop\r\n"
    "      vertex 0 0 0\r\n      vertex 2.0e+0 -0.0 0\r\n      vertex +2 2 0\r\n"
    "    endloop\r\n  endfacet\r\n"
    "  FACET NORMAL nan nan nan\n OUTER LOOP\n"
    "  VERTEX -0 0 0\n VERTEX 2 2 -0\n VERTEX 0 2 0\n ENDLOOP\n ENDFACET\n"
    "endsolid square of 2\n"
    "solid\nfacet normal 0 0 0 outer loop vertex 0 0 5 vertex 1 0 5 vertex 1 1 5 vertex 0 1 5 "
    "endloop endfacet\nendsolid";

std::string binary(std::uint32_t announced, const std::vector<float>& numbers) {
  std::string bytes(80, 'x');
  appendLittleEndian(bytes, announced);
  for (std::size_t i = 0; i < numbers.size(); i += 9) {
    bytes.append(12, '\0');
    for (std::size_t k = i; k < i + 9; ++k) appendLittleEndian(bytes, numbers[k]);
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(ParseStl, ReadsTextAndJoinsEqualCorners) {
  const auto model = parseStl(kText, "f");
  ASSERT_TRUE(model) << model.error().sentence();
  const Mesh& mesh = std::get<Mesh>(*model);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
  EXPECT_EQ(mesh.vertices[1].position, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(mesh.vertices[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(mesh.vertices[0].rgb, kUncoloured);
}

TEST(ParseStl, ReadsBinaryThatBeginsLikeText) {
  std::string bytes = binary(1, kTriangle);
  bytes.replace(0, 5, "solid");
  const auto model = parseStl(bytes, "f");
  ASSERT_TRUE(model) << model.error().sentence();
  EXPECT_EQ(std::get<Mesh>(*model).triangles.size(), 1U);
  EXPECT_TRUE(parseStl(bytes + "appended by somebody", "f"));
}

TEST(ParseStl, PassesOverTrianglesWithoutArea) {
  std::vector<float> numbers(9, 7.0F);
  numbers.insert(numbers.end(), kTriangle.begin(), kTriangle.end());
  const auto model = parseStl(binary(2, numbers), "f");
  ASSERT_TRUE(model);
  EXPECT_EQ(std::get<Mesh>(*model).triangles.size(), 1U);
}

TEST(ParseStl, TellsWhatIsWrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const std::string head = "solid a\n facet normal 0 0 1\n  outer loop\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "no STL"},
      {"hello", "no STL"},
      {std::string(200, 'a'), "cut off, or no STL"},
      {std::string(84, '\0'), "no triangle"},
      {binary(0, {}), "no triangle"},
      {binary(1, {7, 7, 7, 7, 7, 7, 1, 1, 1}), "no triangle"},
      {binary(2, kTriangle), "cut off"},
      {binary(0xFFFFFFFFU, kTriangle), "cut off"},
      {binary(1, kTriangle).substr(0, 133), "cut off"},
      {"solid" + binary(1, kTriangle).substr(5, 100), "cut off"},
      {binary(1, {0, 0, 0, 1, 0, nan, 0, 1, 0}), "no number"},
      {binary(1, {0, 0, 0, 1, 0, 0, 0, -infinite, 0}), "no number"},
      {"solid", "has no end"},
      {"solid a\nendsolid\n", "no triangle"},
      {"solid a\nendsolid\nendsolid\n", "line 3"},
      {head, "line 4"},
      {head + "vertex 1 2\nvertex", "line 5"},
      {head + "vertex 1 2 3,5\n", "line 4"},
      {head + "vertex 1 2 1e999\n", "line 4"},
      {head + "vertex 1 2 nan vertex 0 0 0 vertex 1 0 0 endloop endfacet endsolid", "no number"},
      {head + "vertex 1 2 3 vertex 4 5 6 endloop endfacet endsolid", "line 4"},
      {head + "vertex 1 2 3 vertex 4 5 6 vertex 0 0 0 endloop\n endfacet\n", "has no end"},
      {head + "vertex 1 2 3 vertex 4 5 6 vertex 0 0 0 endloop\n endsolid\n", "line 5"},
  };
  for (const auto& [bytes, problem] : cases) {
    const auto model = parseStl(bytes, "duck.stl");
    ASSERT_FALSE(model) << bytes;
    EXPECT_THAT(model.error().what, HasSubstr("duck.stl"));
    EXPECT_THAT(model.error().what, HasSubstr(problem)) << bytes;
    EXPECT_FALSE(model.error().advice.empty());
  }
}

TEST(ParseStl, SurvivesDamage) {
  for (const std::string& sample : {std::string(kText), *stlBytes(sampleMesh())}) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      const auto model = parseStl(mutated(sample, seed), "f");
      EXPECT_TRUE(model || !model.error().what.empty());
    }
  }
}

}  // namespace
}  // namespace gyre
