// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/clean_words.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace gyre {
namespace {

using ::testing::HasSubstr;

CleanOptions parsed(const std::string& words) {
  CleanOptions options;
  CLI::App command;
  addCleanWords(command, options);
  command.parse(words);
  return options;
}

TEST(CleanWords, SetTheOptionsTheyName) {
  const CleanOptions options = parsed(
      "--crop-radius 70 --z-min 0.5 --z-max 90 --fill-holes 8 --base-cap --smooth 5 "
      "--triangles 20000 --remesh 0.8 --min-component 0.1");
  EXPECT_EQ(options.crop.radius_mm, 70.0);
  EXPECT_EQ(options.crop.z_min_mm, 0.5);
  EXPECT_EQ(options.crop.z_max_mm, 90.0);
  EXPECT_EQ(options.holes.max_width_mm, 8.0);
  EXPECT_TRUE(options.base_cap);
  EXPECT_EQ(options.smooth.iterations, 5);
  EXPECT_EQ(options.decimate.triangles, 20000);
  EXPECT_EQ(options.remesh.edge_mm, 0.8);
  EXPECT_EQ(options.min_component_share, 0.1);
}

TEST(CleanWords, ChangeNothingUnsaid) {
  const CleanOptions options = parsed("");
  EXPECT_EQ(optionTexts(options), optionTexts(CleanOptions{}));
  EXPECT_EQ(parsed("--keep-pieces").min_component_share, 0.0);
}

TEST(CleanWords, RefuseWhatDoesNotFit) {
  EXPECT_THROW(parsed("--smooth -3"), CLI::ParseError);
  EXPECT_THROW(parsed("--triangles many"), CLI::ParseError);
  EXPECT_THROW(parsed("--keep-pieces --min-component 0.1"), CLI::ParseError);
}

TEST(CleanWords, LeaveAWordThatTheCommandHas) {
  CleanOptions options;
  double own = 0.0;
  CLI::App command;
  command.add_option("--min-component", own, "Its own");
  addCleanWords(command, options);
  command.parse("--min-component 0.3");
  EXPECT_EQ(own, 0.3);
  EXPECT_EQ(options.min_component_share, CleanOptions{}.min_component_share);
  EXPECT_THAT(command.help(), HasSubstr("--fill-holes"));
}

}  // namespace
}  // namespace gyre
