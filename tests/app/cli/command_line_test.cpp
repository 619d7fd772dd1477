// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command_line.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/command_answer.h"

namespace gyre {
namespace {

using test::Answer;
using test::gyre;
using ::testing::HasSubstr;

TEST(CommandLine, TellsItsVersionAndItsWords) {
  EXPECT_THAT(gyre({"--version"}).out, HasSubstr("gyre 0."));
  const Answer help = gyre({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* command : {"demo", "scan", "resume", "calibrate", "reconstruct", "mesh",
                              "compare", "devices", "sim-firmware"}) {
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
                                             {"compare", "only-one"}}) {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("--help` lists the words."));
    EXPECT_EQ(answer.out, "");
  }
}

}  // namespace
}  // namespace gyre
