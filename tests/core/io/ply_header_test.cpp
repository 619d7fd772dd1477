// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ply_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(ParsePlyHeader, ReadsElementsAndPropertiesInOrder) {
  const auto header = parsePlyHeader(
      "ply\r\ncomment by hand\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float32 x\n"
      "property double  y \nelement face 0\nproperty list uint8 int32 vertex_index\nend_header\r\n"
      "123456789012",
      "f");
  ASSERT_TRUE(header) << header.error().sentence();
  EXPECT_EQ(header->format, PlyFormat::kBigEndian);
  ASSERT_EQ(header->elements.size(), 2U);
  EXPECT_EQ(header->elements[0].count, 1U);
  EXPECT_EQ(header->elements[0].properties[1].name, "y");
  EXPECT_EQ(header->elements[0].properties[1].type, PlyType::kF64);
  EXPECT_FALSE(header->elements[0].properties[1].list_length_type);
  EXPECT_EQ(header->elements[1].properties[0].list_length_type, PlyType::kU8);
  EXPECT_EQ(header->elements[1].properties[0].type, PlyType::kI32);
}

TEST(ParsePlyHeader, TellsWhatIsWrong) {
  const std::string start = "ply\nformat binary_little_endian 1.0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "no PLY"},
      {"solid cube\n", "no PLY"},
      {"ply\n", "without an end"},
      {start, "without an end"},
      {"ply\nend_header\n", "does not tell its format"},
      {"ply\nformat ascii 2.0\nend_header\n", "line 2"},
      {start + "format ascii 1.0\nend_header\n", "line 3"},
      {start + "element vertex -1\nend_header\n", "line 3"},
      {start + "element vertex 99999999999999999999\nend_header\n", "line 3"},
      {start + "element vertex\nend_header\n", "line 3"},
      {start + "property float x\nend_header\n", "line 3"},
      {start + "element vertex 0\nproperty half x\nend_header\n", "line 4"},
      {start + "element vertex 0\nelement vertex 0\nend_header\n", "line 4"},
      {start + "element face 0\nproperty list float int i\nend_header\n", "line 4"},
      {start + "hello\nend_header\n", "line 3"},
      {start + "element vertex 4\nproperty float x\nend_header\n123456789012", "cut off"},
      {start + "element vertex 18446744073709551615\nproperty double x\nend_header\n", "cut off"},
  };
  for (const auto& [text, problem] : cases) {
    const auto header = parsePlyHeader(text, "duck.ply");
    ASSERT_FALSE(header) << text;
    EXPECT_THAT(header.error().what, HasSubstr("duck.ply"));
    EXPECT_THAT(header.error().what, HasSubstr(problem)) << text;
  }
}

}  // namespace
}  // namespace gyre
