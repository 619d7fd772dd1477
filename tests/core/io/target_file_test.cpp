// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/target_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

Target oddTarget() {
  Target target;
  target.name = "odd \"name\"";
  target.dictionary = "DICT_5X5_250";
  target.corners = {
      {3, {1.0 / 3.0, 0, 5}}, {1, {20, -0.0, 5}}, {40, {0.1 + 0.2, 20, 5}}, {7, {20, 20, 5}}};
  target.faces = {{7, 3, 1, 40}};
  target.page_axes = {{Vector3d::UnitX(), -Vector3d::UnitY()}};
  target.markers = {
      {249, {Vector3d(2, 8, 5), Vector3d(8, 8, 5), Vector3d(8, 2, 5), Vector3d(2, 2, 5)}}};
  target.dots = {{{5, 6, 5}, 4.5}};
  return target;
}

constexpr const char* kExample = R"({"format": "gyre-target", "version": 1, "name": "board",
  "dictionary": "DICT_4X4_50", "corners": [{"id": 0, "x": 0, "y": 0, "z": 2},
  {"id": 1, "x": 10, "y": 0, "z": 2}, {"id": 2, "x": 0, "y": 10, "z": 2}],
  "markers": [{"id": 3, "corners": [[1,9,2],[6,9,2],[6,4,2],[1,4,2]]}],
  "faces": [[0, 1, 2]], "made": "by hand"})";

std::string exampleWith(const std::string& piece, const std::string& replacement) {
  std::string text = kExample;
  const std::size_t at = text.find(piece);
  GYRE_CHECK(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

TEST(WriteTarget, KeepsEveryBit) {
  const TempDir dir;
  const Target target = oddTarget();
  ASSERT_TRUE(writeTarget(dir / "t.json", target));
  const auto back = readTarget(dir / "t.json");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->name, target.name);
  EXPECT_EQ(back->dictionary, target.dictionary);
  ASSERT_EQ(back->corners.size(), target.corners.size());
  for (std::size_t i = 0; i < target.corners.size(); ++i) {
    EXPECT_EQ(back->corners[i].id, target.corners[i].id);
    EXPECT_EQ(back->corners[i].position_in_target, target.corners[i].position_in_target);
  }
  ASSERT_EQ(back->markers.size(), 1U);
  EXPECT_EQ(back->markers[0].id, 249);
  EXPECT_EQ(back->markers[0].corners_in_target, target.markers[0].corners_in_target);
  EXPECT_EQ(back->faces, target.faces);
  ASSERT_EQ(back->page_axes.size(), 1U);
  EXPECT_EQ(back->page_axes[0].down_in_target, target.page_axes[0].down_in_target);
  ASSERT_EQ(back->dots.size(), 1U);
  EXPECT_EQ(back->dots[0].centre_in_target, target.dots[0].centre_in_target);
  EXPECT_EQ(back->dots[0].diameter_mm, 4.5);
}

TEST(WriteTarget, RefusesWhatItCouldNotReadAndLeavesTheFile) {
  const TempDir dir;
  const auto file = putFile(dir / "t.json", "old");
  Target target = oddTarget();
  target.corners[0].position_in_target.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(writeTarget(file, target));
  EXPECT_FALSE(writeTarget(file, Target{}));
  EXPECT_EQ(fileText(file), "old");
}

TEST(ParseTarget, ReadsThePublishedFormAndPassesOverWhatItDoesNotKnow) {
  const auto target = parseTarget(kExample, "f");
  ASSERT_TRUE(target) << target.error().sentence();
  EXPECT_EQ(target->name, "board");
  EXPECT_EQ(target->corners[1].position_in_target, Vector3d(10, 0, 2));
  EXPECT_EQ(target->markers[0].corners_in_target[2], Vector3d(6, 4, 2));
  EXPECT_TRUE(target->page_axes.empty());
}

TEST(ParseTarget, TellsWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "is damaged"},
      {"[]", "\"format\""},
      {exampleWith("gyre-target", "gyre-calibration"), "\"format\""},
      {exampleWith("\"version\": 1", "\"version\": 2"), "version"},
      {exampleWith("\"board\"", "7"), "\"name\""},
      {exampleWith("\"name\"", "\"title\""), "\"name\""},
      {exampleWith("DICT_4X4_50", "DICT_4X4_51"), "DICT_4X4_51"},
      {exampleWith("\"DICT_4X4_50\"", "4"), "\"dictionary\""},
      {exampleWith("\"x\": 10", "\"x\": NaN"), "NaN"},
      {exampleWith("\"x\": 10", "\"x\": 1e300"), "\"x\""},
      {exampleWith("\"x\": 10", "\"x\": \"10\""), "\"x\""},
      {exampleWith("\"x\": 10", "\"u\": 10"), "\"x\""},
      {exampleWith("\"id\": 1", "\"id\": 1.5"), "\"id\""},
      {exampleWith("\"id\": 1", "\"id\": -1"), "\"id\""},
      {exampleWith("\"id\": 1", "\"id\": 99999999999999"), "\"id\""},
      {exampleWith("\"id\": 1", "\"id\": 0"), "twice"},
      {exampleWith("\"corners\": [{", "\"points\": [{"), "\"corners\""},
      {exampleWith("[1,9,2],", ""), "four corners"},
      {exampleWith("[1,9,2]", "[1,9]"), "three numbers"},
      {exampleWith("[1,9,2]", "[3,9,2]"), "no square"},
      {exampleWith("\"id\": 3", "\"id\": 50"), "does not hold"},
      {exampleWith("[[0, 1, 2]]", "[[0, 1, 5]]"), "corner 5"},
      {exampleWith("[[0, 1, 2]]", "[0, 1, 2]"), "\"faces\""},
      {exampleWith("[[0, 1, 2]]", "{}"), "\"faces\""},
      {exampleWith("\"y\": 10, \"z\": 2", "\"y\": 10, \"z\": -3"), "z = 0"},
      {exampleWith("\"made\": \"by hand\"", "\"page_axes\": 3"), "\"page_axes\""},
      {exampleWith("\"made\": \"by hand\"", "\"page_axes\": []"), ""},
      {exampleWith("\"made\": \"by hand\"", "\"dots\": [{\"centre\": [1,2,3], \"diameter\": 0}]"),
       "dot"},
  };
  for (const auto& [text, problem] : cases) {
    const auto target = parseTarget(text, "board.json");
    if (problem.empty()) {
      EXPECT_TRUE(target) << text;
      continue;
    }
    ASSERT_FALSE(target) << text;
    EXPECT_EQ(target.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(target.error().what, HasSubstr("board.json"));
    EXPECT_THAT(target.error().what, HasSubstr(problem)) << text;
    EXPECT_FALSE(target.error().advice.empty());
  }
}

TEST(ReadTarget, NamesTheMissingFile) {
  EXPECT_EQ(readTarget("/nowhere/t.json").error().code, Error::Code::kNotFound);
}

TEST(ParseTarget, SurvivesDamage) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto target = parseTarget(mutated(kExample, seed), "f");
    if (!target) {
      EXPECT_FALSE(target.error().what.empty());
    } else {
      EXPECT_FALSE(pointsOf(*target).empty());
    }
  }
}

}  // namespace
}  // namespace gyre
