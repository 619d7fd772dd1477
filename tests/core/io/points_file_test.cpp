// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/points_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/mutate.h"

namespace gyre {
namespace {

using testing::HasSubstr;

const std::string kSix = "0 0 0 1 2\n0 0 1 1 2\n0 1 0 1 2\n0 1 1 1 2\n1 0 0 1 2\n1 0 1 1 2\n";

TEST(ParsePoints, ReadsWhatPeopleAndProgramsWrite) {
  const auto points = parsePoints(
      "\xEF\xBB\xBF# X Y Z u v\r\n\r\n 1.0000000000e+01\t3.0e+01 0.0 1.2356548051e+02 95.399 \r\n" +
          kSix + "+1, -2.5; 3,4.25, 5 # the last",
      "f");
  ASSERT_TRUE(points) << points.error().sentence();
  ASSERT_EQ(points->size(), 8U);
  EXPECT_EQ(points->front().position_in_target, Eigen::Vector3d(10, 30, 0));
  EXPECT_EQ(points->front().pixel, Eigen::Vector2d(123.56548051, 95.399));
  EXPECT_EQ(points->back().position_in_target, Eigen::Vector3d(1, -2.5, 3));
  EXPECT_EQ(points->back().pixel, Eigen::Vector2d(4.25, 5));
}

TEST(ParsePoints, NamesTheBadLine) {
  for (const std::string line : {"1 2 3 4", "1 2 3 4 5 6", "1 2 3 4 x", "1 2 3 4 nan",
                                 "1 2 inf 4 5", "1 2 3 4 5e999", "X Y Z u v", "1 2 3 4 5mm"}) {
    const auto points = parsePoints("# header\n\n" + line + "\n" + kSix, "cube.txt");
    ASSERT_FALSE(points) << line;
    EXPECT_EQ(points.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(points.error().what, HasSubstr("in line 3"));
    EXPECT_THAT(points.error().what, HasSubstr("cube.txt"));
    EXPECT_FALSE(points.error().advice.empty());
  }
}

TEST(ParsePoints, RefusesTooFew) {
  EXPECT_EQ(parsePoints("", "f").error().code, Error::Code::kTooFew);
  EXPECT_EQ(parsePoints("# nothing\n", "f").error().code, Error::Code::kTooFew);
  EXPECT_THAT(parsePoints(kSix, "f").error().what, HasSubstr("6 points"));
}

TEST(ReadPoints, NamesTheMissingFile) {
  EXPECT_EQ(readPoints("/nowhere/points.txt").error().code, Error::Code::kNotFound);
}

TEST(ParsePoints, SurvivesDamage) {
  const std::string text = "# X Y Z u v\n" + kSix + "1 1 1 5.5 6.25\n";
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto points = parsePoints(mutated(text, seed), "f");
    EXPECT_TRUE(points || !points.error().what.empty());
  }
}

}  // namespace
}  // namespace gyre
