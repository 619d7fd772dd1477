// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command_line.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/ply.h"
#include "tests/support/command_answer.h"
#include "tests/support/surfaces.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using test::Answer;
using test::gyre;
using ::testing::HasSubstr;

TEST(CommandLine, TellsItsVersionAndItsWords) {
  EXPECT_THAT(gyre({"--version"}).out, HasSubstr("gyre 0."));
  const Answer help = gyre({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* command :
       {"demo", "scan", "resume", "calibrate", "reconstruct", "mesh", "compare", "measure",
        "report", "export", "devices", "sim-firmware", "reproduce"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    const Answer own = gyre({command, "--help"});
    EXPECT_EQ(own.code, 0) << command;
    EXPECT_THAT(own.out, HasSubstr("--quiet"));
    EXPECT_THAT(own.out, HasSubstr("--verbose"));
  }
}

TEST(CommandLine, AnswersWrongWordsWithTwoAndASentence) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"frobnicate"},
                                             {"demo"},
                                             {"demo", "--views"},
                                             {"demo", "--views", "many", "--out", "x"},
                                             {"demo", "--quiet", "--verbose", "--out", "x"},
                                             {"compare", "only-one"},
                                             {"measure", "x", "--from", "1,2", "--to", "1,2,3"},
                                             {"export", "x", "--to", "blender", "--out", "y"},
                                             {"reproduce", "--table", "4", "--out", "x"},
                                             {"reconstruct", "x", "--window", "wide", "--out", "x"},
                                             {"reconstruct", "x", "--window", "3", "--out", "x"}}) {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("--help` lists the words."));
    EXPECT_EQ(answer.out, "");
  }
}

TEST(CommandLine, RefusesASolverThatIsNone) {
  const Answer answer = gyre({"reconstruct", "x", "--solver", "best", "--out", "x"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.err, HasSubstr("two-view, squared, absolute or robust"));
  EXPECT_THAT(gyre({"reconstruct", "--help"}).out, HasSubstr("(default robust)"));
}

TEST(CommandLine, ReproducesATableIntoAFolder) {
  const TempDir temp;
  const Answer answer =
      gyre({"reproduce", "--table", "2", "--trials", "1", "--out", (temp / "tables").string()});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("joint_bound_mm"));
  for (const char* ending : {"csv", "json", "svg"}) {
    EXPECT_TRUE(std::filesystem::exists(temp / ("tables/table2." + std::string(ending))));
  }
  EXPECT_FALSE(std::filesystem::exists(temp / "tables/table1.csv"));
}

TEST(CommandLine, WritesASurfaceInEveryFormatAndMeasuresThoseItReads) {
  const TempDir temp;
  const std::string points = (temp / "points.ply").string();
  ASSERT_TRUE(writePly(points, test::sphereCloud(600, 10.0, {0.0, 0.0, 10.5})));
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.3mf", "a.GLB"}) {
    const Answer answer = gyre({"mesh", points, "--out", (temp / name).string()});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(std::filesystem::exists(temp / name)) << name;
    const bool stays = name == std::string("a.ply") || name == std::string("a.obj");
    EXPECT_EQ(answer.out.find("to stand on the bed") == std::string::npos, stays) << answer.out;
  }
  for (const char* name : {"a.obj", "a.stl"}) {
    const Answer answer =
        gyre({"compare", (temp / name).string(), (temp / "a.ply").string(), "--align"});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out, HasSubstr("F-score 100.0 %")) << name;
  }
  const Answer wrong = gyre({"mesh", points, "--out", (temp / "a.step").string()});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr(".stl, .3mf or .glb"));
}

}  // namespace
}  // namespace gyre
