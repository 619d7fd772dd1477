// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/angles_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(ParseAngles, ReadsWhatSpreadsheetsWrite) {
  const auto angles = parseAngles(
      "\xEF\xBB\xBFimage,angle_deg\r\n\r\n\"b,2.png\",-7.2\r\n a1.png , +3.6 \r\na10.png,1.8e2",
      "f");
  ASSERT_TRUE(angles) << angles.error().sentence();
  ASSERT_EQ(angles->size(), 3U);
  EXPECT_DOUBLE_EQ(angles->at("b,2.png"), radFromDeg(-7.2));
  EXPECT_DOUBLE_EQ(angles->at("a1.png"), radFromDeg(3.6));
  EXPECT_DOUBLE_EQ(angles->at("a10.png"), kPi);
}

TEST(ParseAngles, TellsWhatIsWrongAndWhere) {
  const std::string header = "image,angle_deg\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "holds no angle"},
      {header, "holds no angle"},
      {"a.png,1\n", "does not begin"},
      {"image;angle_deg\na.png;1\n", "does not begin"},
      {"image,angle_deg,sigma\na.png,1,2\n", "does not begin"},
      {header + "a.png,1\na.png,2\n", "\"a.png\" a second time in line 3"},
      {header + "a.png,nan\n", "(\"nan\") in line 2"},
      {header + "a.png,inf\n", "no usable angle"},
      {header + "a.png,1e300\n", "no usable angle"},
      {header + "a.png,\n", "no usable angle"},
      {header + "a.png,1 deg\n", "no usable angle"},
      {header + "a.png,3,6\n", "something else"},
      {header + "a.png\n", "something else"},
      {header + ",1\n", "something else"},
      {header + "\"a.png,1\n", "something else"},
      {header + "\"a\"b,1\n", "something else"},
  };
  for (const auto& [text, problem] : cases) {
    const auto angles = parseAngles(text, "angles.csv");
    ASSERT_FALSE(angles) << text;
    EXPECT_EQ(angles.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(angles.error().what, HasSubstr("angles.csv"));
    EXPECT_THAT(angles.error().what, HasSubstr(problem));
    EXPECT_FALSE(angles.error().advice.empty());
  }
}

TEST(WriteAngles, ReadsBackTheSameInNaturalOrder) {
  const TempDir dir;
  const AngleTable angles = {{"v10.png", radFromDeg(18.0)}, {"v9.png", -0.1}, {"\"q\", r", 1e-9}};
  ASSERT_TRUE(writeAngles(dir / "angles.csv", angles));
  const auto back = readAngles(dir / "angles.csv");
  ASSERT_TRUE(back) << back.error().sentence();
  ASSERT_EQ(back->size(), angles.size());
  for (const auto& [name, angle_rad] : angles) EXPECT_NEAR(back->at(name), angle_rad, 1e-15);
  const std::string text = fileText(dir / "angles.csv");
  EXPECT_LT(text.find("v9.png"), text.find("v10.png"));
  EXPECT_THAT(text, testing::StartsWith("image,angle_deg\n"));
}

TEST(ReadAngles, NamesTheMissingFile) {
  EXPECT_EQ(readAngles("/nowhere/angles.csv").error().code, Error::Code::kNotFound);
}

TEST(AnglesOfPictures, FollowThePicturesAndIgnoreLinesWithoutOne) {
  const std::vector<std::filesystem::path> pictures = {"f/b.png", "f/a.png"};
  EXPECT_THAT(*anglesOfPictures(pictures, {{"a.png", 1.0}, {"b.png", 2.0}, {"c.png", 3.0}}),
              testing::ElementsAre(2.0, 1.0));
}

TEST(AnglesOfPictures, RefusesPicturesWithoutALineAndATableThatNeverTurned) {
  const std::vector<std::filesystem::path> pictures = {"a.png", "b.png"};
  EXPECT_THAT(anglesOfPictures(pictures, {{"a.png", 1.0}}).error().what, HasSubstr("\"b.png\""));
  EXPECT_THAT(anglesOfPictures(pictures, {{"a.png", 1.0}, {"b.png", 1.0}}).error().what,
              HasSubstr("same table angle"));
  EXPECT_TRUE(anglesOfPictures({}, {})->empty());
}

TEST(ParseAngles, SurvivesDamage) {
  const std::string text = "image,angle_deg\n\"v,1.png\",1.8\nv2.png,3.6\nv3.png,5.4\n";
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto angles = parseAngles(mutated(text, seed), "f");
    EXPECT_TRUE(angles || !angles.error().what.empty());
  }
}

}  // namespace
}  // namespace gyre
